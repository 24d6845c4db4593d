#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// Checks that `text` is a whole STEP file (ISO 10303-21) before a library parses it: first and last word, header and
/// data section, balanced parentheses, well-formed numbers (OpenCASCADE 7.6 takes 1.2.3 for 1.2). Throws ToolError
/// naming the line.
void check_step_text(std::string_view text, const std::string& file);

}  // namespace bladefit
