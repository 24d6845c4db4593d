#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// A line for each zone of a result, and one for the rest, with what is allowed and what its points came to: `Zone tip
/// edge (auto:5mm r/R 0.7:1.0): +0.100 -0.050 mm; 41 points, 2 out (1 cut, 1 weld), 0 open; from -0.062 to +0.110 mm`.
/// Empty where the result has no zones.
[[nodiscard]] std::string zone_lines(const Result& result);

}  // namespace bladefit
