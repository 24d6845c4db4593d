#pragma once
#include <vector>

#include "core/fit/pose.hpp"
#include "core/geometry/surface/surface.hpp"
#include "core/probe_point.hpp"

namespace bladefit {

/// Whether half of the points are far outside the box of the design at the pose. Cost: linear.
[[nodiscard]] bool is_outside_box(const Surface& surface, const std::vector<ProbePoint>& points, const Pose& pose);

/// Whether half of the points are outside that box, or farther from the surface than a start that needs no second look.
/// Cost: linear, and some dozen searches.
[[nodiscard]] bool is_far_from(const Surface& surface, const std::vector<ProbePoint>& points, const Pose& pose,
                               double probe_radius_mm);

}  // namespace bladefit
