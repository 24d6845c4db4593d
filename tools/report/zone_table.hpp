#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// Each zone with what is allowed on either side and what its points came to, and last the rest of the blade, as an
/// HTML table. Empty where the result has no zones.
[[nodiscard]] std::string zone_table(const Result& result);

}  // namespace bladefit
