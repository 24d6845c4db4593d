#include "tests/support/mode_value.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/nearest/global_projection.hpp"

namespace bladefit::testing {

Foot ModeValue::foot(const ProbePoint& point, const Pose& pose) const {
  ProjectionQuery query{apply(pose, Vec3(point.position.data())), Vec3::Zero(), 0.0};
  if (config_.use_approach) query.approach = pose.rotation * Vec3(point.approach.data());
  const Projection nearest = project_global(design_.surface(), query, nullptr).nearest;
  return foot_of(design_.surface(), nearest, config_.probe_radius_mm);
}

double ModeValue::weight(const Foot& foot) const {
  ToleranceMap bounds = config_.tolerance;
  if (config_.mode == FitMode::minimax || config_.mode == FitMode::range) return 1.0;
  if (config_.mode != FitMode::constrained) {
    bounds.leading_edge_mm = 1.0;
    bounds.rest_mm = config_.ratio;
  }
  return tolerance_at(bounds, foot.patch, foot.u, foot.v);
}

double ModeValue::weight(Region region) const {
  const bool edge = region == Region::leading_edge;
  if (config_.mode == FitMode::minimax || config_.mode == FitMode::range) return 1.0;
  if (config_.mode == FitMode::constrained) return edge ? config_.tolerance.leading_edge_mm : config_.tolerance.rest_mm;
  return edge ? 1.0 : config_.ratio;
}

double ModeValue::at(const Pose& pose) const {
  double least = std::numeric_limits<double>::infinity(), most = -least, ratio = 0.0, square = 0.0;
  for (const ProbePoint& point : points_) {
    const Foot found = foot(point, pose);
    least = std::min(least, found.distance);
    most = std::max(most, found.distance);
    ratio = std::max(ratio, std::abs(found.distance) / weight(found));
    square += point.weight * found.distance * found.distance;
  }
  if (config_.mode == FitMode::constrained || config_.mode == FitMode::least_squares) return square;
  return config_.mode == FitMode::range ? most - least : ratio;
}

double ModeValue::largest_ratio(const Pose& pose) const {
  double ratio = 0.0;
  for (const ProbePoint& point : points_) {
    const Foot found = foot(point, pose);
    ratio = std::max(ratio, std::abs(found.distance) / weight(found));
  }
  return ratio;
}

}  // namespace bladefit::testing
