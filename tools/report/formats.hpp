#pragma once
#include <array>
#include <string>
#include <string_view>

#include "tools/report/csv_report.hpp"
#include "tools/report/html_report.hpp"
#include "tools/report/json_report.hpp"
#include "tools/report/pdf_report.hpp"
#include "tools/report/qif_report.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// A way to write a result: a function of the record alone.
struct ReportFormat {
  std::string_view name;  ///< on the command line
  std::string_view help;
  std::string (*text_of)(const Result&);
};

/// All formats. A new one is a pair of files and a row here.
inline constexpr std::array<ReportFormat, 5> kFormats{
    {{"html", "one page to look at, print and send: verdict, defects, pictures, tables by radius and chord, settings",
      html_report},
     {"pdf", "the same as A4 pages, printed by Chromium, which must be installed", pdf_report},
     {"csv", "one line a point, units in the names of the columns", csv_report},
     {"json", "the result as `bladefit run` wrote it, checked", json_report},
     {"qif", "QIF 3.0 (ISO 23952): a feature and a characteristic for each point, with measured places and status",
      qif_report}}};

/// The format of that name. Throws ToolError (bad_input) that names those there are.
[[nodiscard]] const ReportFormat& format_of(std::string_view name);

/// The format that the end of a file's name tells, as .html does. Throws ToolError (bad_input) that names those there
/// are.
[[nodiscard]] const ReportFormat& format_of_file(const std::string& path);

/// The names of all formats with `joint` between them, but `last_joint` before the last: "html, csv and json".
[[nodiscard]] std::string format_names(std::string_view joint, std::string_view last_joint);

}  // namespace bladefit
