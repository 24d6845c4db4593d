#include "tools/design/image/leaf_subdivision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/nearest/leaf_bounds.hpp"

namespace bladefit {
namespace {

/// Boxes are wider than their control points by this share of their coordinates, so that whoever checks the image may
/// round otherwise.
constexpr double kBoxMargin = 1e-13;

Box control_box(const BezierNet& net) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t k = 0; k < (net.degree_u + 1) * (net.degree_v + 1); ++k) {
      const double coordinate = net.points[k][axis] / net.points[k][3];
      low = std::min(low, coordinate);
      high = std::max(high, coordinate);
    }
    const double margin = kBoxMargin * std::max(std::abs(low), std::abs(high));
    box.min[axis] = low - margin;
    box.max[axis] = high + margin;
  }
  return box;
}

Vec3 vector_of(const float (&x)[3]) { return {x[0], x[1], x[2]}; }

/// How far off the surface the distance can be convex: half the least radius of curvature.
double reach(const ImageBounds& b, double near) {
  double curvature = 0;
  for (int d = 2; d < 5; ++d) {
    const double middle = std::abs(static_cast<double>(b.derivative[d][0]));
    curvature = std::max(curvature, middle + from_half_float(b.spread[d][0]));
  }
  return curvature * near > 0.5 ? 0.5 / curvature : near;
}

/// How far the distance is from losing convexity, over the leaf and for points `near` to it: a lower bound of the
/// smallest eigenvalue of its Hessian, which is 1 for a flat leaf.
double convexity(const ImageBounds& b, double near) {
  const double off = reach(b, near);
  Vec3 low, high;
  for (int k = 0; k < 3; ++k) {
    low[k] = from_half_float(b.low[k]);
    high[k] = from_half_float(b.high[k]);
  }
  double least = 1;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 w((corner & 1) != 0 ? high[0] + off : low[0] - off, (corner & 2) != 0 ? high[1] : low[1],
                 (corner & 4) != 0 ? high[2] : low[2]);
    const DerivativeRanges r = derivative_ranges(b, w);
    least = std::min(least, std::min(r.uu.least, r.vv.least) - std::max(std::abs(r.uv.least), std::abs(r.uv.most)));
  }
  return least;
}

/// Its lengths along s and along t in the middle [mm].
std::array<double, 2> lengths_of(const ImageBounds& b) {
  return {vector_of(b.derivative[0]).norm(), vector_of(b.derivative[1]).norm()};
}

bool hair_thin(const ImageBounds& b) {
  const auto [along_s, along_t] = lengths_of(b);
  return along_s > kHairThin * along_t || along_t > kHairThin * along_s;
}

class Subdivision {
 public:
  Subdivision(const BezierSpan& span, double near) : span_(span), net_(net_of(span)), near_(near) {}

  [[nodiscard]] LeafCandidate candidate(const LocalRect& rect, int cuts) const {
    LeafCandidate c;
    const auto single = [](double x) { return static_cast<float>(x); };
    c.leaf = {
        0, 0, single(rect.s_min), single(rect.s_max), single(rect.t_min), single(rect.t_max), leaf_bounds(span_, rect),
        {}};
    c.cuts = cuts;
    BezierNet net = net_;
    restrict_net(rect, net);
    c.box = control_box(net);
    return c;
  }

  /// Puts in what is gained by cutting a candidate: searches look at it by the area from which it is near.
  void weigh(LeafCandidate& c) const {
    const double convex = convexity(c.leaf.bounds, near_);
    if (c.cuts == kLeafCuts || convex > 0) return;
    const auto [along_s, along_t] = lengths_of(c.leaf.bounds);
    c.gain = (along_s + near_) * (along_t + near_) * std::clamp(-convex, 0.01, 1.0);
  }

  /// Halves across s or across t, whichever leaves the worse half better off; a hair-thin one along its length, since
  /// what is as long as the blade has no tight box.
  [[nodiscard]] std::array<LeafCandidate, 2> halves(const LeafCandidate& whole) const {
    const auto [along_s, along_t] = lengths_of(whole.leaf.bounds);
    if (along_s > kHairThin * along_t) return halves_across_s(whole);
    if (along_t > kHairThin * along_s) return halves_across_t(whole);
    const std::array<LeafCandidate, 2> across_s = halves_across_s(whole), across_t = halves_across_t(whole);
    const auto worse = [this](const std::array<LeafCandidate, 2>& c) {
      return std::min(convexity(c[0].leaf.bounds, near_), convexity(c[1].leaf.bounds, near_));
    };
    return worse(across_s) >= worse(across_t) ? across_s : across_t;
  }

 private:
  [[nodiscard]] std::array<LeafCandidate, 2> halves_across_s(const LeafCandidate& whole) const {
    LocalRect low = rect_of(whole.leaf), high = low;
    low.s_max = high.s_min = 0.5 * (low.s_min + low.s_max);
    return {candidate(low, whole.cuts + 1), candidate(high, whole.cuts + 1)};
  }
  [[nodiscard]] std::array<LeafCandidate, 2> halves_across_t(const LeafCandidate& whole) const {
    LocalRect low = rect_of(whole.leaf), high = low;
    low.t_max = high.t_min = 0.5 * (low.t_min + low.t_max);
    return {candidate(low, whole.cuts + 1), candidate(high, whole.cuts + 1)};
  }

  BezierSpan span_;
  BezierNet net_;
  double near_;
};

}  // namespace

LeafTree cut_into_leaves(const BezierSpan& span, double near) {
  const Subdivision subdivision(span, near);
  LeafTree tree{subdivision.candidate({}, 0)};
  for (std::size_t k = 0; k < tree.size(); ++k) {
    subdivision.weigh(tree[k]);
    if (tree[k].gain == 0) continue;
    const std::array<LeafCandidate, 2> halves = subdivision.halves(tree[k]);
    tree[k].halves = tree.size();
    tree.insert(tree.end(), halves.begin(), halves.end());
  }
  return tree;
}

LeafTree keep_as_leaf(const BezierSpan& span, double near) {
  LeafCandidate whole = Subdivision(span, near).candidate({}, 0);
  if (hair_thin(whole.leaf.bounds)) return cut_into_leaves(span, near);
  return {whole};
}

}  // namespace bladefit
