#include "tools/commands/report_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "firmware_bridge/host/journal/session_file_names.hpp"
#include "tools/commands/progress_line.hpp"
#include "tools/drawing/add_drawing.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/report/formats.hpp"
#include "tools/results/session_files.hpp"

namespace bladefit {
namespace {

struct ReportOptions {
  std::string session, format, output;
};

std::string report_help() {
  std::size_t width = 0;
  for (const ReportFormat& format : kFormats) width = std::max(width, format.name.size());
  std::string text = "\nFormats:\n";
  for (const ReportFormat& format : kFormats) text += fmt::format("  {:<{}}  {}\n", format.name, width, format.help);
  return text + R"(
Example:
  bladefit report session --format html -o blade.html

Exit codes: 0 done, 2 wrong use or a session that cannot be reported, 3 the report cannot be written (for pdf also:
there is nothing that prints a page).)";
}

/// The report must not take the place of what it is made from.
void check_output(const ReportOptions& options) {
  for (const char* name : {kResultFile, kVerdictsFile, kJournalFile, kSettingsFile, kRecordFile, kDesignFile}) {
    std::error_code error;
    if (std::filesystem::equivalent(options.output, std::filesystem::path(options.session) / name, error)) {
      throw ToolError(fmt::format("{}: the report would overwrite the session; give another name", options.output));
    }
  }
}

/// The session as reports show it: with what its design lets draw.
Result session_result(const std::string& directory) {
  Result result = read_session(directory);
  result.written = utc_now();
  const std::vector<std::byte> image = read_session_design(directory, *result.identity);
  DesignImage design;
  if (!image.empty() && DesignImage::open(image, design) == Status::ok) add_drawing(design, result);
  return result;
}

void report(const ReportOptions& options) {
  const ReportFormat& format = format_of(options.format);
  check_output(options);
  std::optional<ProgressLine> progress(options.output != "-");
  progress->begin("writing the report");
  write_output(options.output, format.text_of(session_result(options.session)));
  progress.reset();
  if (options.output != "-") fmt::print("Written: {}\n", options.output);
}

}  // namespace

void add_report_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand("report", "write what a session found as a page, a table or a data file");
  command->footer(report_help());
  command->add_option("session", options->session, "folder that `bladefit run --session` wrote")
      ->required()
      ->type_name("SESSION_DIR");
  command->add_option("--format", options->format, "what to write")->required()->type_name(format_names("|", "|"));
  command->add_option("-o,--output", options->output, "file to write; - is standard output")
      ->required()
      ->type_name("OUT");
  command->callback([options, &exit_code] {
    report(*options);
    exit_code = 0;
  });
}

}  // namespace bladefit
