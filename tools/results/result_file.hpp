#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/inspection/verdict.hpp"
#include "tools/results/session_report.hpp"

namespace bladefit {

/// What result.json says of one point: enough to tell whether verdicts.csv is of the same run.
struct ResultPoint {
  std::uint32_t index = 0;
  PointState state = PointState::pending;
};

struct ResultContent {
  ReportedFit fit;
  std::vector<ResultPoint> points;
};

/// Reads the text of a result.json; `path` names it in errors. Throws ToolError (bad_input) that names the line or
/// the field and the mend.
[[nodiscard]] ResultContent parse_result(const std::string& path, const std::string& text);

}  // namespace bladefit
