#include "tools/design/image/surface_part.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Boxes are wider than what they hold by this share of the coordinates: rounding.
constexpr double kPlaceRounding = 1e-13;

/// Largest eigenvalue of the second fundamental form over the first, of a side.
double largest_curvature(const SurfacePoint& at, const Vec3& normal) {
  const double e = at.s_u.squaredNorm(), f = at.s_u.dot(at.s_v), g = at.s_v.squaredNorm(), det = e * g - f * f;
  const double l = at.s_uu.dot(normal), m = at.s_uv.dot(normal), n = at.s_vv.dot(normal);
  const double mean = 0.5 * (e * n - 2.0 * f * m + g * l) / det, gauss = (l * n - m * m) / det;
  return mean + std::sqrt(std::max(0.0, mean * mean - gauss));
}

IntervalVector interval_cross(const IntervalVector& a, const IntervalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

LocalRect half_rect(LocalRect rect, bool along_s, bool high) {
  double& low_side = along_s ? rect.s_min : rect.t_min;
  double& high_side = along_s ? rect.s_max : rect.t_max;
  (high ? low_side : high_side) = 0.5 * (low_side + high_side);
  return rect;
}

}  // namespace

BezierNet bezier_net_of(const Surface& surface, std::uint32_t span) {
  BezierNet net;
  surface.net(span, net);
  return net;
}

bool PatchRect::holds(const PatchRect& other) const {
  return patch == other.patch && limits.u_min <= other.limits.u_min && limits.u_max >= other.limits.u_max &&
         limits.v_min <= other.limits.v_min && limits.v_max >= other.limits.v_max;
}

PatchRect hull_of(const PatchRect& a, const PatchRect& b) {
  return {a.patch,
          std::min(a.iu_low, b.iu_low),
          std::max(a.iu_high, b.iu_high),
          std::min(a.iv_low, b.iv_low),
          std::max(a.iv_high, b.iv_high),
          {std::min(a.limits.u_min, b.limits.u_min), std::max(a.limits.u_max, b.limits.u_max),
           std::min(a.limits.v_min, b.limits.v_min), std::max(a.limits.v_max, b.limits.v_max)}};
}

SurfacePart::SurfacePart(const Surface& surface, std::uint32_t span, const LocalRect& rect, int cuts)
    : surface_(surface), span_(span), rect_(rect), cuts_(cuts) {
  const SpanDomain d = surface.domain(span);
  const auto at = [](double low, double high, double x) { return low + x * (high - low); };
  const ImageSpan& s = surface.span(span);
  patch_rect_ = {s.patch,
                 s.iu,
                 s.iu,
                 s.iv,
                 s.iv,
                 {at(d.u_min, d.u_max, rect.s_min), at(d.u_min, d.u_max, rect.s_max), at(d.v_min, d.v_max, rect.t_min),
                  at(d.v_min, d.v_max, rect.t_max)}};
  BezierNet net = bezier_net_of(surface, span);
  restrict_net(rect, net);
  const std::uint32_t rows = net.degree_u, columns = net.degree_v;
  points_.reserve((rows + 1) * (columns + 1));
  for (std::uint32_t k = 0; k < (rows + 1) * (columns + 1); ++k)
    points_.emplace_back(net.points[k].head<3>() / net.points[k][3]);
  const auto way = [&](std::uint32_t first, std::uint32_t steps, std::uint32_t stride) {
    double sum = 0;
    for (std::uint32_t k = 0; k < steps; ++k)
      sum += (points_[first + (k + 1) * stride] - points_[first + k * stride]).norm();
    return sum;
  };
  double along_s = 0, along_t = 0;
  for (std::uint32_t i = 0; i <= rows; ++i) along_t = std::max(along_t, way(i * (columns + 1), columns, 1));
  for (std::uint32_t j = 0; j <= columns; ++j) along_s = std::max(along_s, way(j, rows, columns + 1));
  longer_along_s_ = along_s >= along_t;
  size_ = std::hypot(along_s, along_t);
}

IntervalVector SurfacePart::box_in(const PieceFrame& frame) const {
  IntervalVector box{kNothing, kNothing, kNothing};
  double farthest = 0;
  for (const Vec3& point : points_) {
    const Vec3 at = frame.axes * (point - frame.middle);
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = at[static_cast<Eigen::Index>(k)];
      box[k].include({x, x});
    }
    farthest = std::max(farthest, point.norm());
  }
  for (Interval& axis : box) {
    axis.low -= kPlaceRounding * farthest;
    axis.high += kPlaceRounding * farthest;
  }
  return box;
}

const PartView& SurfacePart::view() {
  if (!view_) make_view();
  return *view_;
}

void SurfacePart::make_view() {
  view_ = std::make_unique<PartView>();
  PartView& view = *view_;
  const SpanDomain& r = patch_rect_.limits;
  const SurfacePoint middle = surface_.evaluate({span_, 0.5 * (r.u_min + r.u_max), 0.5 * (r.v_min + r.v_max)});
  const Vec3 normal = middle.s_u.cross(middle.s_v);
  if (!(normal.norm() > 1e-6 * middle.s_u.norm() * middle.s_v.norm())) return;
  const Vec3 up = normal.normalized(), along = middle.s_u.normalized(), across = up.cross(along);
  view.frame.axes.row(0) = up;
  view.frame.axes.row(1) = along;
  view.frame.axes.row(2) = across;
  view.frame.middle = middle.s;
  view.stretch[0] = 1.0 / middle.s_u.norm();
  view.stretch[1] = 1.0 / across.dot(middle.s_v);
  view.stretch[2] = -view.stretch[0] * view.stretch[1] * along.dot(middle.s_v);
  view.curvature[0] = largest_curvature(middle, up);
  view.curvature[1] = largest_curvature(middle, -up);
  view.place = box_in(view.frame);
  const double width_u = r.u_max - r.u_min, width_v = r.v_max - r.v_min;
  const PieceRange range =
      FramedPiece(bezier_net_of(surface_, span_), rect_, view.frame, {1.0 / width_u, 1.0 / width_v}).range();
  const IntervalVector a = view.stretch[0] * range.derivative[0],
                       b = view.stretch[1] * range.derivative[1] + view.stretch[2] * range.derivative[0];
  const IntervalVector turned = interval_cross(a, b);
  if (!(turned[0].low > 0.0)) return;
  const Interval over = inverse(turned[0]);
  view.slope[0] = over * turned[1];
  view.slope[1] = over * turned[2];
  view.regular = true;
}

std::array<SurfacePart*, 2> SurfacePart::halves() {
  for (const std::size_t k : {0U, 1U}) {
    if (halves_[k]) continue;
    halves_[k] = std::make_unique<SurfacePart>(surface_, span_, half_rect(rect_, longer_along_s_, k == 1), cuts_ + 1);
  }
  return {halves_[0].get(), halves_[1].get()};
}

}  // namespace bladefit
