#pragma once
#include <string>
#include <vector>

#include "tools/batch/fit_options.hpp"

namespace bladefit {

/// One sentence where nearly all probing directions run out of the material at their nearest places, at this pose:
/// then the outward side or the directions are the wrong way round. Empty where they do not, or
/// are few. Cost: some dozen searches.
[[nodiscard]] std::string wrong_directions(const DesignImage& design, const FitPlan& plan,
                                           const std::vector<ProbePoint>& points, const Pose& pose);

/// Throws ToolError where `outward` names the side that a closed shape has its material on. Cost: some milliseconds.
void check_outward(const DesignImage& design, const OutwardChoice& outward);

}  // namespace bladefit
