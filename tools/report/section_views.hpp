#pragma once
#include <string>

#include "tools/report/tolerance_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// The leading edge of the section at each measured radius: the design's curve with its tolerance band, and the points
/// near it, their distances exaggerated along the normal. A picture each, three a row. Empty where the leading edge is
/// not known.
[[nodiscard]] std::string section_views(const Result& result, const ToleranceScale& scale);

/// The factor by which distances are exaggerated where a tolerance [mm] is to be drawn `wanted` long at a scale: the
/// greatest of 1, 2, 5, 10 ... that is not above.
[[nodiscard]] double round_factor(double wanted, double tolerance, double scale);

}  // namespace bladefit
