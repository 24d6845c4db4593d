#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// What the operator wants to know, some lines: points, fit, and the points out of tolerance with cut or weld.
/// `result` must have its details: it comes from a fit, not from the files of a session.
[[nodiscard]] std::string operator_summary(const Result& result);

}  // namespace bladefit
