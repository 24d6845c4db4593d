#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// Reads the text of a result.json; `path` names it in errors. Of the points it fills sequence and state alone:
/// verdicts.csv holds them whole, and these tell whether the two files are of the same run. Written by result_json()
/// again, its figures are the same to the last digit. Throws ToolError (bad_input) that names the line or the field and
/// the fix.
[[nodiscard]] Result parse_result(const std::string& path, const std::string& text);

}  // namespace bladefit
