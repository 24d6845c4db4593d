#pragma once
#include <string>

#include "tools/report/tolerance_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// Height of the legend [SVG units].
inline constexpr double kLegendRoom = 56;

/// The colours as shares of the tolerance, and the marks of points that occur, `width` wide with its top at (x, y).
[[nodiscard]] std::string tolerance_legend(const Result& result, const ToleranceScale& scale, double x, double y);

}  // namespace bladefit
