#include "tools/commands/localize_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "drivers/replay/points_csv.hpp"
#include "drivers/text/read_file.hpp"
#include "firmware_bridge/host/journal/session_settings_file.hpp"
#include "tools/batch/batch_fit.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/commands/design_notes.hpp"
#include "tools/commands/fit_flags.hpp"
#include "tools/commands/progress_line.hpp"
#include "tools/commands/report_record_of.hpp"
#include "tools/commands/volume_flags.hpp"
#include "tools/drawing/add_drawing.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/read_text.hpp"
#include "tools/report/formats.hpp"
#include "tools/results/json_writer.hpp"
#include "tools/results/operator_summary.hpp"

namespace bladefit {
namespace {

struct LocalizeFlags {
  Volume volume;
  std::vector<std::string> designs;
  std::string points, subset, json, config, starts, report;
  FitSettings fit;
};

/// Row numbers, counted from 0, one a line; every one below `rows`, none twice. Returned sorted.
std::vector<std::size_t> read_subset(const std::string& path, std::size_t rows) {
  const std::string text = read_text(path, "subset");
  std::vector<std::size_t> indices;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(text.find('\n', begin), text.size());
    ++line;
    std::size_t last = end;
    if (last > begin && text[last - 1] == '\r') --last;
    if (last > begin) {
      std::size_t value = 0;
      const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + last, value);
      if (error != std::errc() || stop != text.data() + last) {
        throw ToolError(fmt::format("{}:{}: '{}' is not a row number; write one number, counted from 0, a line", path,
                                    line, text.substr(begin, last - begin)));
      }
      if (value >= rows) {
        throw ToolError(fmt::format("{}:{}: row {} is not in the points file, which has rows 0 to {}", path, line,
                                    value, rows - 1));
      }
      indices.push_back(value);
    }
    begin = end + 1;
  }
  std::sort(indices.begin(), indices.end());
  if (const auto twice = std::adjacent_find(indices.begin(), indices.end()); twice != indices.end())
    throw ToolError(fmt::format("{}: row {} is named twice; name each row once", path, *twice));
  return indices;
}

std::vector<ProbePoint> read_points(const LocalizeFlags& flags, FitPlan& plan) {
  PointsFile file = read_points_csv(flags.points, plan.points);
  if (file.error) throw ToolError(file.error);
  plan.points.unit = file.unit;
  for (const std::string& note : file.notes) plan.note += note + "\n";
  if (!flags.subset.empty()) {
    std::vector<ProbePoint> chosen;
    for (const std::size_t index : read_subset(flags.subset, file.points.size())) chosen.push_back(file.points[index]);
    file.points = std::move(chosen);
  }
  if (file.points.empty()) {
    throw ToolError(fmt::format("{}: names no point; probe some, or name another file",
                                flags.subset.empty() ? file_name(flags.points) : flags.subset));
  }
  return file.points;
}

/// What is written must not take the place of anything it is made from.
void check_output_file(const std::string& output, const LocalizeFlags& flags, const FitSettings& settings) {
  if (output == "-") return;
  for (const std::string& design : flags.designs) refuse_overwriting(output, "design", design);
  refuse_overwriting(output, "points", flags.points);
  refuse_overwriting(output, "subset", flags.subset);
  refuse_overwriting(output, "settings", flags.config);
  refuse_overwriting(output, "start pairs", start_file_of(settings));
  refuse_overwriting(output, "zones", settings.zones_file);
}

/// Everything wrong with the outputs is said before the fit.
void check_outputs(const LocalizeFlags& flags, const FitSettings& settings) {
  check_output_file(flags.json, flags, settings);
  if (flags.report.empty()) return;
  check_output_file(flags.report, flags, settings);
  refuse_overwriting(flags.report, "copy of the result", flags.json);
  static_cast<void>(format_of_file(flags.report));
}

/// Adds what reports have beside the result, and writes the one that is asked for.
void write_report(const LocalizeFlags& flags, const FitPlan& plan, const DesignImage& design, std::string begun,
                  Result& result) {
  ReportIdentity identity;
  if (!flags.config.empty()) {
    if (const Failure error = load_report_identity(flags.config, identity)) throw ToolError(error);
  }
  FileRoles inputs;
  for (const std::string& file : flags.designs) inputs.emplace_back("design", file);
  inputs.insert(inputs.end(), {{"points", flags.points}, {"subset", flags.subset}, {"settings", flags.config}});
  result.record = report_record_of(identity, inputs);
  result.record->begun = std::move(begun);
  result.record->ended = result.written = utc_now();
  result.settings = named_settings(settings_text(plan.localizer, 0));
  add_drawing(design, result);
  write_output(flags.report, format_of_file(flags.report).text_of(result));
}

/// What there is to know beside the summary, which comes first: its first line is the verdict.
void tell_besides(const LocalizeFlags& flags, const LoadedDesign& design, const FitPlan& plan, const BatchFit& batch,
                  std::FILE* words) {
  tell_notes(design, words);
  fmt::print(words, "{}", plan.note);
  if (!flags.starts.empty()) {
    fmt::print(words, "starts: {} of {} first feet were not the nearest{}\n", batch.wrong_starts,
               batch.result.points.size(), batch.wrong_starts > 0 ? "; fitted again from searched ones" : "");
  }
  for (const std::string& file : {flags.json, flags.report})
    if (!file.empty() && file != "-") fmt::print(words, "Written: {}\n", file);
}

int localize(const LocalizeFlags& flags) {
  FitSettings from_file;
  if (!flags.config.empty()) {
    if (const Failure error = load_fit(flags.config, from_file)) throw ToolError(error);
  }
  const FitSettings settings = merged(flags.fit, from_file);
  check_outputs(flags, settings);
  const std::string begun = utc_now();
  const bool json_on_stdout = flags.json == "-";
  std::FILE* words = json_on_stdout ? stderr : stdout;
  StepClock clock(flags.volume);
  std::optional<ProgressLine> progress(!flags.volume.quiet);
  progress->begin("reading the design");
  const LoadedDesign loaded = load_design(
      std::vector<std::filesystem::path>(flags.designs.begin(), flags.designs.end()), design_choice_of(settings));
  DesignImage design;
  if (const Status status = DesignImage::open(loaded.image, design); status != Status::ok)
    throw ToolError(fmt::format("{}: {}", flags.designs.front(), status_text(status)));
  FitPlan plan = plan_fit(settings, design);
  clock.done("design loaded");
  if (!flags.starts.empty()) plan.starts = parse_starts(flags.starts);
  const std::vector<ProbePoint> points = read_points(flags, plan);
  clock.done("points read");
  progress->begin(fmt::format("fitting {} points", points.size()));
  BatchFit batch = fit_points(design, plan, points, file_name(flags.points));
  clock.done("points fitted and judged");
  Result& result = batch.result;
  if (json_on_stdout) progress.reset();
  if (progress) progress->begin("writing");
  if (!flags.json.empty()) write_output(flags.json, result_json(result));
  if (!flags.report.empty()) write_report(flags, plan, design, begun, result);
  progress.reset();
  fmt::print(words, "{}", told_of(operator_summary(result), flags.volume));
  if (!flags.volume.quiet) tell_besides(flags, loaded, plan, batch, words);
  return exit_code_of(result);
}

}  // namespace

void add_localize_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<LocalizeFlags>();
  CLI::App* command = app.add_subcommand("localize", "fit measured points to a design and judge them");
  command->footer(
      "\nExamples:\n"
      "  bladefit localize --design blade.igs --points points.csv --leading-edge u:0.4:0.6 --tolerance 0.1mm\n"
      "  bladefit localize --design blade.bfd --points - --mode min_tolerance --leading-edge auto:5mm --json - "
      "< points.csv");
  command
      ->add_option("--design", flags->designs,
                   "design: .igs .iges .stp .step, or .bfd from `bladefit compile`; - reads standard input; repeat it "
                   "for a blade in several files")
      ->allow_extra_args(false)
      ->required();
  command
      ->add_option("--points", flags->points,
                   "CSV with columns x,y,z and optionally i,j,k, path, weight; - reads standard input")
      ->required();
  command->add_option("--subset", flags->subset,
                      "file of row numbers of the points to use, counted from 0, one a line");
  command->add_option(
      "--json", flags->json,
      "write result.json here; - writes it to standard output; its indices count points from 0, the words from 1");
  command->add_option(
      "--report", flags->report,
      fmt::format("write a report; the end of its name says as what: .{}", format_names(", .", " or .")));
  command->add_option(
      "--config", flags->config,
      "TOML with a [fit] table, and a [report] table of what reports say of the blade (see config/fit.toml); options "
      "given here win over it");
  command->add_option(
      "--starts", flags->starts,
      "how the first foot of each point is found; the answer is the same, since all feet are proven by searches at the "
      "start and at the end. "
      "curves: from the cubic through its path; neighbour: from the point before on its path; global: by a search. "
      "Default: from the point before, then a search");
  add_volume_flags(*command, flags->volume);
  add_fit_options(*command, flags->fit);
  command->callback([flags, &exit_code] { exit_code = localize(*flags); });
}

}  // namespace bladefit
