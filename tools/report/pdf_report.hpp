#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// The page of html_report() as a PDF file of A4 pages, printed by Chromium; WeasyPrint would cut off the last columns
/// of wide tables. Throws ToolError (device) where Chromium is not there or fails. Cost: a second and more.
[[nodiscard]] std::string pdf_report(const Result& result);

}  // namespace bladefit
