#pragma once
#include <string>

#include "tools/results/session_report.hpp"

namespace bladefit {

/// Points, distances and tolerance by region, as an HTML table.
[[nodiscard]] std::string region_table(const SessionReport& report);

/// Where the measured part lies: the motion from the machine to the design, with standard uncertainties.
[[nodiscard]] std::string pose_table(const SessionReport& report);

/// The points to cut or to weld, worst first, those of the leading edge before the others.
[[nodiscard]] std::string out_table(const SessionReport& report);

}  // namespace bladefit
