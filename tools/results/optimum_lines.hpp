#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// What the mode found, in words, with the points that prove it; empty in least squares and in a constrained fit that
/// meets its tolerances, and where the files that a result was read from do not tell all of it.
[[nodiscard]] std::string optimum_lines(const Result& result);

/// A length in the units of a result, as the operator reads it: "0.0134 in".
[[nodiscard]] std::string length_text(const Result& result, double mm);

}  // namespace bladefit
