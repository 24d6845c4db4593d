#pragma once
#include <vector>

#include "core/fit/pose.hpp"
#include "firmware_bridge/host/blade/blade_counts.hpp"

namespace bladefit {

/// Points that are out in the same region, by the same action and within 3 % of R of each other are one defect.
/// The one farthest off in tolerances comes first. Of more than 2048 points those that are farthest off are looked at.
/// Cost: n log n in these.
[[nodiscard]] std::vector<BladeDefect> joined_defects(const BladeLayout& layout, const BladeCounts& counts,
                                                      const Pose& pose);

/// A place of the design as the machine names it [mm].
[[nodiscard]] std::array<float, 3> in_machine(const Pose& pose, const Vec3& design_point);

}  // namespace bladefit
