#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// result.json: to the letter as it stands in the folder of a session, so that nothing is lost that another version
/// wrote there; otherwise as `localize` writes it.
[[nodiscard]] std::string json_report(const Result& result);

}  // namespace bladefit
