#include "core/geometry/nearest/leaf_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

double dot(const float (&a)[3], const Vec3& b) {
  return static_cast<double>(a[0]) * b[0] + static_cast<double>(a[1]) * b[1] + static_cast<double>(a[2]) * b[2];
}

double dot(const HalfFloat (&a)[3], const Vec3& b) {
  return from_half_float(a[0]) * b[0] + from_half_float(a[1]) * b[1] + from_half_float(a[2]) * b[2];
}

ValueRange range_of(const ImageBounds& bounds, int k, const Vec3& w, const Vec3& magnitude) {
  const double middle = dot(bounds.derivative[k], w), spread = dot(bounds.spread[k], magnitude);
  return {from_half_float(bounds.self_low[k]) - middle - spread,
          from_half_float(bounds.self_high[k]) - middle + spread};
}

}  // namespace

Vec3 in_frame(const ImageBounds& bounds, const Vec3& r) {
  const Vec3 arm(r[0] - static_cast<double>(bounds.middle[0]), r[1] - static_cast<double>(bounds.middle[1]),
                 r[2] - static_cast<double>(bounds.middle[2]));
  return {dot(bounds.axis[0], arm), dot(bounds.axis[1], arm), dot(bounds.axis[2], arm)};
}

double least_distance(const ImageBounds& bounds, const Vec3& w) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double beyond =
        std::max({from_half_float(bounds.low[k]) - w[k], w[k] - from_half_float(bounds.high[k]), 0.0});
    sum += beyond * beyond;
  }
  return std::sqrt(sum);
}

DerivativeRanges derivative_ranges(const ImageBounds& bounds, const Vec3& w) {
  const Vec3 magnitude = w.cwiseAbs();
  const auto range = [&](int k) { return range_of(bounds, k, w, magnitude); };
  return {range(0), range(1), range(2), range(3), range(4)};
}

bool slopes_across(const ImageBounds& bounds, const Vec3& w) {
  const Vec3 magnitude = w.cwiseAbs();
  for (const int k : {5, 6}) {
    const ValueRange slope = range_of(bounds, k, w, magnitude);
    if (slope.least > 0.0 || slope.most < 0.0) return true;
  }
  return false;
}

DerivativeRanges ranges_along_t(const ImageBounds& bounds, const DerivativeRanges& ranges) {
  // St = (Sb - k Sa) / stretch[1].
  const double k = static_cast<double>(bounds.stretch[2]) / static_cast<double>(bounds.stretch[0]);
  DerivativeRanges out = ranges;
  out.vv.least += k * k * ranges.uu.least - 2.0 * std::max(k * ranges.uv.least, k * ranges.uv.most);
  out.vv.most += k * k * ranges.uu.most - 2.0 * std::min(k * ranges.uv.least, k * ranges.uv.most);
  return out;
}

LocalPlace first_guess(const ImageBounds& bounds, const Vec3& w) {
  const Vec3 stretch(bounds.stretch[0], bounds.stretch[1], bounds.stretch[2]);
  const double g_s = dot(bounds.derivative[0], w), g_t = dot(bounds.derivative[1], w);
  const double g_a = stretch[0] * g_s, g_b = stretch[1] * g_t + stretch[2] * g_s;
  double aa = 1.0 - dot(bounds.derivative[2], w), bb = 1.0 - dot(bounds.derivative[4], w);
  double ab = -dot(bounds.derivative[3], w);
  if (!(aa > 0.0 && aa * bb - ab * ab > 1e-3)) {
    aa = bb = 1.0;
    ab = 0.0;
  }
  const double det = aa * bb - ab * ab;
  const double a = (bb * g_a - ab * g_b) / det, b = (aa * g_b - ab * g_a) / det;
  return {0.5 + stretch[0] * a + stretch[2] * b, 0.5 + stretch[1] * b};
}

}  // namespace bladefit
