#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// Checks the text of a STEP file as far as is needed to be sure that OpenCASCADE reads what is written there: it
/// begins and ends as STEP files do, parentheses, strings and comments end, numbers are numbers, no instance is given
/// twice, refers to one that is not there, or to itself. Returns the text for OpenCASCADE, which loses the exponents of
/// reals written otherwise than 1.5E3: without a byte order mark, reals with a point and an upper-case exponent. Throws
/// ToolError naming the line. Cost: linear in the size of the text but for sorting the instances.
std::string clean_step_text(std::string_view text, const std::string& file);

}  // namespace bladefit
