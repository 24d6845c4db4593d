#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// What a text holds that the parser must not see: keys of so many parts that a table for each costs the stack,
/// headers of tables without a name, which it takes for granted, and letters beyond ASCII outside of quotes and
/// comments. One line, "line: what; what to do"; empty where there is nothing. Cost: linear.
[[nodiscard]] std::string toml_text_fault(std::string_view text);

}  // namespace bladefit
