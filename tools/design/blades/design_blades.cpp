#include "tools/design/blades/design_blades.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/surface/joint.hpp"
#include "tools/design/blades/face_groups.hpp"

namespace bladefit {
namespace {

/// By which groups that a turn brings into each other may differ: the areas; the centres and the moments, of the size.
/// Trimmed faces are known to a cell of the grid of samples.
constexpr double kAreaShare = 0.03, kPlaceShare = 0.02, kSpreadShare = 0.03;
/// Groups nearer to the axis than this part of their size do not repeat about it.
constexpr double kOffAxis = 0.05;
/// A part belongs to the blade whose angle is nearer than this part of the next one's.
constexpr double kClearlyNearer = 0.6;
/// An axis takes the place of one before it if its blades and hub have so much more area.
constexpr double kMoreArea = 1.02;
/// Two blades are as near to the first direction [rad].
constexpr double kSameAngle = 1e-6;

double size_of_group(const FaceGroup& group) { return std::sqrt(std::max(group.spread.trace(), 0.0)); }

bool congruent(const FaceGroup& a, const FaceGroup& b) {
  const double size = size_of_group(a);
  return std::abs(a.area - b.area) <= kAreaShare * a.area && std::abs(a.radius - b.radius) <= kPlaceShare * size &&
         std::abs(a.height - b.height) <= kPlaceShare * size &&
         (a.spread - b.spread).norm() <= kSpreadShare * size * size;
}

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

/// Groups that a turn about the axis brings into each other, the largest area first.
std::vector<std::vector<FaceGroup>> repeated_groups(const std::vector<FaceGroup>& groups) {
  std::vector<std::vector<FaceGroup>> classes;
  for (const FaceGroup& group : groups) {
    if (group.radius <= kOffAxis * size_of_group(group)) continue;
    const auto like = std::ranges::find_if(classes, [&](const auto& one) { return congruent(one.front(), group); });
    if (like == classes.end()) {
      classes.push_back({group});
    } else {
      like->push_back(group);
    }
  }
  std::erase_if(classes, [](const auto& one) { return one.size() < 2; });
  std::ranges::stable_sort(classes, std::ranges::greater(),
                           [](const auto& one) { return one.front().area * static_cast<double>(one.size()); });
  return classes;
}

/// Adds each group of `parts` to the blade at the nearest angle; false where one is between two, or a blade gets
/// another number of them than the others.
bool add_parts(const std::vector<FaceGroup>& parts, std::vector<DesignBlade>& blades) {
  std::vector<std::size_t> taken(blades.size(), 0);
  for (const FaceGroup& part : parts) {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t k = 0; k < blades.size(); ++k) near.emplace_back(angle_between(part.angle, blades[k].angle), k);
    std::ranges::sort(near);
    if (near[0].first > kClearlyNearer * near[1].first) return false;
    DesignBlade& blade = blades[near[0].second];
    blade.faces.insert(blade.faces.end(), part.faces.begin(), part.faces.end());
    ++taken[near[0].second];
  }
  return std::ranges::all_of(taken, [&](std::size_t count) { return count == taken[0]; });
}

/// That nearest to the first direction first, then as the right hand turns.
void sort_blades(std::vector<DesignBlade>& blades) {
  const auto first = std::ranges::min_element(blades, [](const DesignBlade& a, const DesignBlade& b) {
    const double more = angle_between(a.angle, 0) - angle_between(b.angle, 0);
    return std::abs(more) > kSameAngle ? more < 0 : a.angle > b.angle;
  });
  const double start = first->angle;
  const auto turned = [start](const DesignBlade& blade) {
    const double angle = blade.angle - start;
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
  };
  std::ranges::sort(blades, {}, turned);
  for (DesignBlade& blade : blades) std::ranges::sort(blade.faces);
}

/// The blades about one axis, and the area of blades and hub.
std::pair<DesignBlades, double> blades_about(const ShaftAxis& axis, const std::vector<std::vector<FaceSample>>& samples,
                                             const std::vector<Neighbours>& neighbours) {
  DesignBlades found;
  found.axis = axis;
  const FaceGroups groups = group_faces(samples, neighbours, axis);
  const std::vector<std::vector<FaceGroup>> classes = repeated_groups(groups.groups);
  if (classes.empty()) return {found, 0};
  const std::vector<FaceGroup>& largest = classes.front();
  for (const FaceGroup& group : largest) found.blades.push_back({group.faces, group.angle});
  double area = groups.hub_area + largest.front().area * static_cast<double>(largest.size());
  for (std::size_t k = 1; k < classes.size(); ++k) {
    const std::vector<FaceGroup>& parts = classes[k];
    if (parts.size() % largest.size() != 0 || parts.front().radius < largest.front().least_radius) continue;
    if (!add_parts(parts, found.blades)) return {DesignBlades{axis, {}, {}, {}}, 0};
    area += parts.front().area * static_cast<double>(parts.size());
  }
  found.hub = groups.hub;
  std::vector<bool> used(samples.size(), false);
  for (const DesignBlade& blade : found.blades) {
    for (const std::size_t face : blade.faces) used[face] = true;
  }
  for (const std::size_t face : found.hub) used[face] = true;
  for (std::size_t face = 0; face < used.size(); ++face) {
    if (!used[face]) found.others.push_back(face);
  }
  sort_blades(found.blades);
  return {found, area};
}

}  // namespace

DesignBlades find_blades(const std::vector<NurbsSurface>& surfaces, const std::optional<ShaftAxis>& axis) {
  const std::vector<std::vector<FaceSample>> samples = sample_faces(surfaces);
  Eigen::AlignedBox3d box;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double whole = 0;
  for (const auto& face : samples) {
    for (const FaceSample& sample : face) {
      box.extend(sample.point);
      centre += sample.area * sample.point;
      whole += sample.area;
    }
  }
  centre /= std::max(whole, 1e-300);
  const std::vector<Neighbours> neighbours = find_neighbours(surfaces, joint_gap(0.5 * box.diagonal().norm()));
  std::vector<ShaftAxis> axes;
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(Eigen::Vector3d::Zero()), centre}) {
    for (int k = 0; k < 3 && !axis; ++k) axes.push_back({point, Eigen::Vector3d::Unit(k)});
  }
  if (axis) axes.push_back(*axis);
  DesignBlades best;
  double most = 0;
  for (const ShaftAxis& candidate : axes) {
    auto [found, area] = blades_about(candidate, samples, neighbours);
    if (found.blades.empty() || area <= kMoreArea * most) continue;
    most = area;
    best = std::move(found);
  }
  return best;
}

}  // namespace bladefit
