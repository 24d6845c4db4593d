#include "tools/batch/far_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/batch/outliers.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {
namespace {

/// Points that are looked at where one stands for many.
constexpr std::size_t kLooks = 25;
/// [half diagonals] What is farther from the box of the design than the first, or from its surface than the second, is
/// far.
constexpr double kFarFromBox = 0.5, kFarFromSurface = 0.02;

/// Half of the points are farther from the box of the control points than this at the pose [mm].
double distance_from_box(const Surface& surface, const std::vector<ProbePoint>& points, const Pose& pose) {
  const ImageHeader& header = surface.image().header();
  const Vec3 low(header.box_min), high(header.box_max);
  std::vector<double> distances;
  for (const ProbePoint& point : points) {
    const Vec3 at = apply(pose, Vec3(point.position.data()));
    distances.push_back((at - at.cwiseMax(low).cwiseMin(high)).norm());
  }
  return median(distances);
}

double distance_from_surface(const Surface& surface, const std::vector<ProbePoint>& points, const Pose& pose,
                             double probe_radius_mm) {
  std::vector<double> distances;
  for (const ProbePoint& point : points) {
    const ProjectionQuery query{apply(pose, Vec3(point.position.data()))};
    const double distance = std::sqrt(project_global(surface, query, nullptr).nearest.distance_squared());
    distances.push_back(std::abs(distance - probe_radius_mm));
  }
  return median(distances);
}

}  // namespace

bool is_outside_box(const Surface& surface, const std::vector<ProbePoint>& points, const Pose& pose) {
  return distance_from_box(surface, points, pose) > kFarFromBox * surface.half_diagonal();
}

bool is_far_from(const Surface& surface, const std::vector<ProbePoint>& points, const Pose& pose,
                 double probe_radius_mm) {
  if (is_outside_box(surface, points, pose)) return true;
  const double off = distance_from_surface(surface, some_of(points, kLooks), pose, probe_radius_mm);
  return off > kFarFromSurface * surface.half_diagonal();
}

}  // namespace bladefit
