#include "tools/commands/report_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/report/csv_report.hpp"
#include "tools/report/html_report.hpp"
#include "tools/results/session_report.hpp"

namespace bladefit {
namespace {

struct ReportOptions {
  std::string session, format, output;
};

constexpr const char* kReportHelp = R"(
Formats:
  html  one page to look at, print and send: summary, regions, pose, points to cut or weld, map, histogram
  csv   one line a point, units in the names of the columns
  json  the result as `bladefit run` wrote it, checked

Example:
  bladefit report session --format html -o blade.html

Exit codes: 0 done, 2 wrong use or a session that cannot be reported, 3 the report cannot be written.)";

std::string content_of(const std::string& format, const SessionReport& report) {
  if (format == "csv") return csv_report(report);
  if (format == "html") return html_report(report);
  return report.result_text;
}

void check_format(const std::string& format) {
  if (format == "html" || format == "csv" || format == "json") return;
  throw ToolError(
      fmt::format("--format {}: is not in this version; the formats are html, csv and json", format.substr(0, 20)));
}

/// The report must not take the place of what it is made from.
void check_output(const ReportOptions& options) {
  for (const char* name : {kResultFile, kVerdictsFile, kJournalFile}) {
    std::error_code error;
    if (std::filesystem::equivalent(options.output, std::filesystem::path(options.session) / name, error)) {
      throw ToolError(fmt::format("{}: the report would overwrite the session; give another name", options.output));
    }
  }
}

void report(const ReportOptions& options) {
  check_format(options.format);
  check_output(options);
  const SessionReport session = read_session(options.session);
  OutputFile(options.output, content_of(options.format, session)).commit();
  fmt::print("Written: {}\n", options.output);
}

}  // namespace

void add_report_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand("report", "write what a session found as a page, a table or a data file");
  command->footer(kReportHelp);
  command->add_option("session", options->session, "folder that `bladefit run --session` wrote")
      ->required()
      ->type_name("SESSION_DIR");
  command->add_option("--format", options->format, "what to write")->required()->type_name("html|csv|json");
  command->add_option("-o,--output", options->output, "file to write")->required()->type_name("OUT");
  command->callback([options, &exit_code] {
    report(*options);
    exit_code = 0;
  });
}

}  // namespace bladefit
