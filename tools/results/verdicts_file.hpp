#pragma once
#include <string>
#include <vector>

#include "tools/results/session_report.hpp"

namespace bladefit {

/// Reads the text of a verdicts.csv, which is in mm; lengths are divided by `mm_per_unit`. `path` names it in errors.
/// Throws ToolError (bad_input) that names the line, the column and the mend.
[[nodiscard]] std::vector<ReportPoint> parse_verdicts(const std::string& path, std::string_view text,
                                                      double mm_per_unit);

}  // namespace bladefit
