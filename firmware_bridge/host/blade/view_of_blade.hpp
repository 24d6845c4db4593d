#pragma once
#include "core/localizer.hpp"
#include "firmware_bridge/host/blade/blade_counts.hpp"

namespace bladefit {

/// What is known of places by the verdicts counted, at the pose of the report. Cost: linear in the places of the
/// layout, and that of joined_defects().
[[nodiscard]] BladeView view_of_blade(const BladeLayout& layout, const BladeCounts& counts, const FitReport& report);

}  // namespace bladefit
