#include "firmware_bridge/host/blade/defects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace bladefit {
namespace {

constexpr double kNeighbours = 0.03;  ///< shares of R between neighbouring points

double in_tolerances(const Verdict& verdict) { return std::abs(verdict.foot.distance) / verdict.tolerance_mm; }

/// The points that are looked at, the worst first.
std::vector<const Verdict*> worst_first(const std::map<std::uint32_t, Verdict>& out) {
  std::vector<const Verdict*> points;
  points.reserve(out.size());
  for (const auto& [sequence, verdict] : out) points.push_back(&verdict);
  std::stable_sort(points.begin(), points.end(),
                   [](const Verdict* a, const Verdict* b) { return in_tolerances(*a) > in_tolerances(*b); });
  if (points.size() > kMostJoined) points.resize(kMostJoined);
  return points;
}

/// Sets of points that grow together; each is named by its first point, which is its worst.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  [[nodiscard]] std::size_t first_of(std::size_t point) {
    while (parent_[point] != point) {
      parent_[point] = parent_[parent_[point]];
      point = parent_[point];
    }
    return point;
  }
  void join(std::size_t a, std::size_t b) {
    a = first_of(a);
    b = first_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// A cube as wide as neighbours are apart, of one region and action.
using Cube = std::array<std::int64_t, 4>;

Cube cube_of(const Verdict& verdict, double width) {
  const Vec3& place = verdict.foot.point;
  const auto index = [&](int axis) { return static_cast<std::int64_t>(std::floor(place(axis) / width)); };
  return {index(0), index(1), index(2),
          static_cast<std::int64_t>(verdict.action) * 2 + static_cast<std::int64_t>(verdict.region)};
}

/// The cube itself and those that touch it.
template <typename Visit>
void for_neighbours(const Cube& cube, Visit&& visit) {
  for (std::int64_t x = -1; x <= 1; ++x) {
    for (std::int64_t y = -1; y <= 1; ++y) {
      for (std::int64_t z = -1; z <= 1; ++z) visit(Cube{cube[0] + x, cube[1] + y, cube[2] + z, cube[3]});
    }
  }
}

std::vector<std::vector<const Verdict*>> joined(const std::vector<const Verdict*>& points, double width) {
  std::map<Cube, std::vector<std::size_t>> cubes;
  for (std::size_t k = 0; k < points.size(); ++k) cubes[cube_of(*points[k], width)].push_back(k);
  Sets sets(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    for_neighbours(cube_of(*points[k], width), [&](const Cube& cube) {
      const auto found = cubes.find(cube);
      if (found == cubes.end()) return;
      for (const std::size_t other : found->second) {
        const bool near = (points[k]->foot.point - points[other]->foot.point).norm() <= width;
        if (other < k && near) sets.join(k, other);
      }
    });
  }
  std::map<std::size_t, std::vector<const Verdict*>> groups;
  for (std::size_t k = 0; k < points.size(); ++k) groups[sets.first_of(k)].push_back(points[k]);
  std::vector<std::vector<const Verdict*>> sorted;
  sorted.reserve(groups.size());
  for (auto& [first, group] : groups) sorted.push_back(std::move(group));
  return sorted;
}

/// The point of a defect farthest from a place.
const Vec3& farthest(const std::vector<const Verdict*>& points, const Vec3& from) {
  const auto apart = [&from](const Verdict* point) { return (point->foot.point - from).squaredNorm(); };
  return (*std::ranges::max_element(points, {}, apart))->foot.point;
}

BladeDefect defect_of(const std::vector<const Verdict*>& points, const BladeLayout& layout, const Pose& pose) {
  const Verdict& worst = *points.front();
  const Foot& foot = worst.foot;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Verdict* point : points) {
    const double radius = layout.axis().radius_of(point->foot.point);
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  const Vec3& end = farthest(points, foot.point);
  return {.sequence = worst.sequence,
          .from_ratio = static_cast<float>(layout.ratio_of(least)),
          .to_ratio = static_cast<float>(layout.ratio_of(most)),
          .length = static_cast<float>((farthest(points, end) - end).norm()),
          .distance = static_cast<float>(foot.distance),
          .side = layout.side_of(foot.point, foot.normal, worst.region),
          .action = worst.action,
          .region = worst.region,
          .points = static_cast<std::uint16_t>(points.size()),
          .machine = in_machine(pose, foot.point + foot.distance * foot.normal)};
}

}  // namespace

std::array<float, 3> in_machine(const Pose& pose, const Vec3& design_point) {
  const Vec3 place = pose.rotation.transpose() * (design_point - pose.translation);
  return {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())};
}

std::vector<BladeDefect> joined_defects(const BladeLayout& layout, const std::map<std::uint32_t, Verdict>& out,
                                        const Pose& pose) {
  const std::vector<const Verdict*> points = worst_first(out);
  const double width = kNeighbours * layout.tip_radius_mm();
  std::vector<BladeDefect> defects;
  if (points.empty() || !(width > 0)) return defects;
  for (const auto& group : joined(points, width)) defects.push_back(defect_of(group, layout, pose));
  return defects;
}

}  // namespace bladefit
