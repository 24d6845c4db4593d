#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// One page of HTML that holds all it needs: summary in words, map of the blade, points to cut or weld, regions, pose,
/// histogram. Nothing in it is fetched from elsewhere and nothing runs.
[[nodiscard]] std::string html_report(const Result& result);

}  // namespace bladefit
