#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// What the operator wants to know, some lines: points, fit, and the points out of tolerance with cut or weld.
/// Of a result that was read back from the files of a session, what they do not hold is left out.
[[nodiscard]] std::string operator_summary(const Result& result);

}  // namespace bladefit
