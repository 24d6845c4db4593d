#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// Points, distances and tolerance by region, as an HTML table.
[[nodiscard]] std::string region_table(const Result& result);

/// Where the measured part lies: the motion from the machine to the design, with standard uncertainties.
[[nodiscard]] std::string pose_table(const Result& result);

/// The points to cut or to weld, worst first, those of the leading edge before the others.
[[nodiscard]] std::string out_table(const Result& result);

}  // namespace bladefit
