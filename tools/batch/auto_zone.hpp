#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "config/fit_text.hpp"
#include "tools/batch/fit_options.hpp"

namespace bladefit {

/// A zone of the leading edge that is given by its reach.
struct NumberedZone {
  EdgeZone zone;
  std::uint32_t number = 0;  ///< that its boxes get
  std::string title;         ///< how errors name it
};

/// Finds those of `zones`, and adds their boxes to the plan's tolerance map, each with its number; what was found is
/// added to the notes. Units and axis of the plan are set. Throws ToolError (bad_input) where the design has no ridge,
/// or where several ridges may be the leading edge: then it tells their places.
void plan_auto_zones(const std::vector<NumberedZone>& zones, const FitSettings& settings, const Surface& surface,
                     FitPlan& plan);

/// The same of the zones of --leading-edge, numbered as they stand there.
void plan_auto_zones(const FitSettings& settings, const Surface& surface, FitPlan& plan);

}  // namespace bladefit
