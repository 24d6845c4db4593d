#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "core/fit/pose.hpp"
#include "firmware_bridge/host/blade/blade_layout.hpp"

namespace bladefit {

/// Points that are out in the same region, by the same action and within 3 % of R of each other are one defect.
/// The one farthest off in tolerances comes first. `out` are the points that are out, by sequence; of more than
/// kMostJoined those that are farthest off are looked at. Cost: n log n in these.
[[nodiscard]] std::vector<BladeDefect> joined_defects(const BladeLayout& layout,
                                                      const std::map<std::uint32_t, Verdict>& out, const Pose& pose);
inline constexpr std::size_t kMostJoined = 2048;

/// A place of the design as the machine names it [mm].
[[nodiscard]] std::array<float, 3> in_machine(const Pose& pose, const Vec3& design_point);

}  // namespace bladefit
