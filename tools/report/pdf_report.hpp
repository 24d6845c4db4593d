#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// The page of html_report() as a PDF file of A4 pages, printed by Chromium or, where that is not installed, by
/// WeasyPrint. Throws ToolError (device) where neither is there, or it fails: what one cannot print is not given to the
/// other. Cost: a second and more.
[[nodiscard]] std::string pdf_report(const Result& result);

}  // namespace bladefit
