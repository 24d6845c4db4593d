#pragma once
#include <string>

#include "tools/report/colour_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// An SVG histogram of the signed distances of all points that count, one panel a region with a common scale, the
/// tolerances as dashed lines. Empty text where no point counts.
[[nodiscard]] std::string distance_histogram(const Result& result, const ColourScale& scale);

}  // namespace bladefit
