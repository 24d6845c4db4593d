#include "tools/design/image/reach_guess.hpp"

#include <algorithm>

#include "core/geometry/nearest/bounding_tree.hpp"

namespace bladefit {
namespace {

/// [half diagonals]
constexpr double kMost = 0.5;
/// Samples this near to the foot [half diagonals] say nothing but its curvature.
constexpr double kSamePlace = 1e-5;

double square_to_box(const ImageNode& node, std::size_t child, const Vec3& from_middle) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = from_middle[static_cast<Eigen::Index>(axis)];
    const double off = std::max(
        {static_cast<double>(node.low[axis][child]) - x, x - static_cast<double>(node.high[axis][child]), 0.0});
    sum += off * off;
  }
  return sum;
}

}  // namespace

ReachGuess::ReachGuess(const Surface& surface) : surface_(surface), most_(kMost * surface.half_diagonal()) {
  for (const ImageLeaf& leaf : surface.image().leaves()) {
    const SpanDomain d = surface.domain(leaf.span);
    const LocalRect rect = rect_of(leaf);
    std::array<Vec3, 9>& places = samples_.emplace_back();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const std::size_t row = k / 3, column = k % 3;
      const double s = rect.s_min + 0.5 * static_cast<double>(row) * (rect.s_max - rect.s_min);
      const double t = rect.t_min + 0.5 * static_cast<double>(column) * (rect.t_max - rect.t_min);
      places[k] = surface.evaluate({leaf.span, d.u_min + s * (d.u_max - d.u_min), d.v_min + t * (d.v_max - d.v_min)}).s;
    }
  }
}

double ReachGuess::radius_at(const Vec3& foot, const Vec3& normal, double most) const {
  const double same = kSamePlace * surface_.half_diagonal();
  double radius = most;
  const auto shrink = [&](const Vec3& sample) {
    const Vec3 arm = sample - foot;
    const double rise = arm.dot(normal), square = arm.squaredNorm();
    if (square > same * same && 2.0 * radius * rise > square) radius = 0.5 * square / rise;
  };
  std::vector<std::uint32_t> pending{0};
  while (!pending.empty()) {
    const ImageNode& node = surface_.image().nodes()[pending.back()];
    pending.pop_back();
    for (std::size_t k = 0; k < 4 && node.child[k] != kNoChild; ++k) {
      const Vec3 centre = foot + radius * normal - surface_.middle();
      if (square_to_box(node, k, centre) >= radius * radius) continue;
      const std::uint32_t index = node.child[k] & ~kLeafChild;
      if ((node.child[k] & kLeafChild) == 0) {
        pending.push_back(index);
      } else if (index < samples_.size()) {
        for (const Vec3& sample : samples_[index]) shrink(sample);
      }
    }
  }
  return radius;
}

}  // namespace bladefit
