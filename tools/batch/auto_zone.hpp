#pragma once
#include <optional>
#include <string>
#include <vector>

#include "config/fit_text.hpp"
#include "tools/batch/fit_options.hpp"

namespace bladefit {

/// Finds the zones of `settings` that are given by their reach from the leading edge, and adds their boxes to the
/// plan's tolerance map, those of a zone with its number; what was found is added to the notes. Units and axis of the
/// plan are set. Throws ToolError (bad_input) where the design has no ridge, or where several ridges may be the leading
/// edge: then it tells their places.
void plan_auto_zones(const FitSettings& settings, const Surface& surface, FitPlan& plan);

}  // namespace bladefit
