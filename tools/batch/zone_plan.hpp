#pragma once
#include "tools/batch/fit_options.hpp"

namespace bladefit {

/// Turns the tables [[zone]] of `settings` to the zones of the plan's tolerance map, with their names; what lies
/// outside of all keeps the rest tolerance. Units, window, axis and R of the plan are set. Nothing where there is no
/// such table. Throws ToolError (bad_input) that names the zone, the field and the fix: where an option says the same
/// in another way, and where no place of the design lies in a zone.
void plan_zones(const FitSettings& settings, const Surface& surface, FitPlan& plan);

/// How errors name a zone: `zone 2 "tip edge"`.
[[nodiscard]] std::string zone_title(const FitPlan& plan, std::size_t index);

}  // namespace bladefit
