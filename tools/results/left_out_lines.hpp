#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// Points that are not judged, or lie where the design has no surface, and why: a line each; empty where none is.
[[nodiscard]] std::string left_out_lines(const Result& result);

}  // namespace bladefit
