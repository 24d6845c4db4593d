#include "tools/design/image/leaf_subdivision.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/nearest/leaf_bounds.hpp"

namespace bladefit {
namespace {

/// How far off the surface the distance can be convex: half the least radius of curvature.
double reach(const ImageBounds& b, double near) {
  double curvature = 0;
  for (int d = 2; d < 5; ++d) curvature = std::max(curvature, std::abs(b.derivative[d][0]) + b.spread[d][0]);
  return curvature * near > 0.5 ? 0.5 / curvature : near;
}

/// How far the distance is from losing convexity, over the leaf and for points `near` to it: a lower bound of the
/// smallest eigenvalue of its Hessian, which is 1 for a flat leaf.
double convexity(const ImageBounds& b, double near) {
  const double off = reach(b, near);
  double least = 1;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 w((corner & 1) != 0 ? b.high[0] + off : b.low[0] - off, (corner & 2) != 0 ? b.high[1] : b.low[1],
                 (corner & 4) != 0 ? b.high[2] : b.low[2]);
    const DerivativeRanges r = derivative_ranges(b, w);
    least = std::min(least, std::min(r.uu.least, r.vv.least) - std::max(std::abs(r.uv.least), std::abs(r.uv.most)));
  }
  return least;
}

/// A rectangle with its bounds.
struct Candidate {
  LocalRect rect;
  int cuts = 0;
  ImageBounds bounds;
  double convex = 0;
};

class Subdivision {
 public:
  Subdivision(const BezierSpan& span, double near) : span_(span), near_(near) {}

  [[nodiscard]] Candidate candidate(const LocalRect& rect, int cuts) const {
    Candidate c{rect, cuts, leaf_bounds(span_, rect), 0};
    c.convex = convexity(c.bounds, near_);
    return c;
  }

  /// Halves across s or across t, whichever leaves the worse half better off; a hair-thin one along its length, since
  /// what is as long as the blade has no tight box.
  [[nodiscard]] std::array<Candidate, 2> halves(const Candidate& whole) const {
    const ImageBounds& b = whole.bounds;
    const double along_s = Vec3(b.derivative[0]).norm(), along_t = Vec3(b.derivative[1]).norm();
    if (along_s > kHairThin * along_t) return halves_across_s(whole);
    if (along_t > kHairThin * along_s) return halves_across_t(whole);
    const std::array<Candidate, 2> across_s = halves_across_s(whole), across_t = halves_across_t(whole);
    const auto worse = [](const std::array<Candidate, 2>& c) { return std::min(c[0].convex, c[1].convex); };
    return worse(across_s) >= worse(across_t) ? across_s : across_t;
  }

 private:
  [[nodiscard]] std::array<Candidate, 2> halves_across_s(const Candidate& whole) const {
    LocalRect low = whole.rect, high = whole.rect;
    low.s_max = high.s_min = 0.5 * (whole.rect.s_min + whole.rect.s_max);
    return {candidate(low, whole.cuts + 1), candidate(high, whole.cuts + 1)};
  }
  [[nodiscard]] std::array<Candidate, 2> halves_across_t(const Candidate& whole) const {
    LocalRect low = whole.rect, high = whole.rect;
    low.t_max = high.t_min = 0.5 * (whole.rect.t_min + whole.rect.t_max);
    return {candidate(low, whole.cuts + 1), candidate(high, whole.cuts + 1)};
  }

  BezierSpan span_;
  double near_;
};

}  // namespace

std::vector<ImageLeaf> cut_into_leaves(const BezierSpan& span, double near) {
  const Subdivision subdivision(span, near);
  std::vector<ImageLeaf> leaves;
  std::vector<Candidate> pending{subdivision.candidate({}, 0)};
  while (!pending.empty()) {
    const Candidate c = pending.back();
    pending.pop_back();
    if (c.cuts == kLeafCuts || c.convex > 0) {
      leaves.push_back({0, 0, c.rect.s_min, c.rect.s_max, c.rect.t_min, c.rect.t_max, c.bounds});
      continue;
    }
    const std::array<Candidate, 2> halves = subdivision.halves(c);
    pending.push_back(halves[1]);
    pending.push_back(halves[0]);
  }
  return leaves;
}

std::vector<ImageLeaf> keep_as_leaf(const BezierSpan& span, double near) {
  const LocalRect whole{};
  const ImageBounds bounds = leaf_bounds(span, whole);
  const double along_s = Vec3(bounds.derivative[0]).norm(), along_t = Vec3(bounds.derivative[1]).norm();
  if (along_s > kHairThin * along_t || along_t > kHairThin * along_s) return cut_into_leaves(span, near);
  return {{0, 0, whole.s_min, whole.s_max, whole.t_min, whole.t_max, bounds}};
}

}  // namespace bladefit
