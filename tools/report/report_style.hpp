#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// The style sheet of the page, with head, foot and page numbers of its print on A4 portrait.
[[nodiscard]] std::string report_style(const Result& result);

}  // namespace bladefit
