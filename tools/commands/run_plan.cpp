#include "tools/commands/run_plan.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <utility>

#include "drivers/source_uri.hpp"
#include "firmware_bridge/host/journal/session_file_names.hpp"
#include "firmware_bridge/host/panel/panel_address.hpp"
#include "tools/batch/tip_radius.hpp"
#include "tools/commands/session_source.hpp"
#include "tools/files/output_file.hpp"
#include "tools/web/web_panel.hpp"

namespace bladefit {
namespace {

constexpr double kMillisecondsPerSecond = 1000;
constexpr double kLongestIdle_s = 1e6;

template <typename Value>
void over(std::optional<Value>& target, const std::optional<Value>& flag) {
  if (flag) target = flag;
}

SessionSettings merged_session(const RunFlags& flags) {
  SessionSettings session;
  if (!flags.config.empty()) {
    if (const Failure error = load_session(flags.config, session)) throw ToolError(error);
  }
  over(session.design, flags.session.design);
  over(session.source, flags.session.source);
  over(session.session, flags.session.session);
  over(session.until_idle, flags.session.until_idle);
  over(session.headless, flags.session.headless);
  over(session.plan, flags.session.plan);
  session.fit = merged(flags.session.fit, session.fit);
  return session;
}

/// `flags` win over what a device file says of its recording; `plan` stands in where neither says anything.
SourceSettings plan_source(const SessionSettings& session, const FitSettings& flags, const PointsFormat& plan) {
  SourceSettings source = source_of(session);
  auto* const replay = std::get_if<ReplaySettings>(&source);
  if (replay != nullptr) {
    PointsFormat& format = replay->format;
    format.unit = plan.unit;
    if (flags.units || !format.given_unit) format.given_unit = plan.given_unit;
    if (flags.columns || format.columns.empty()) format.columns = plan.columns;
  }
  return source;
}

PanelServerSettings plan_panel(const PanelSettings& file, const std::string& flag) {
  PanelServerSettings panel;
  if (file.address) panel.host = *file.address;
  if (file.port) panel.port = *file.port;
  if (file.commands) panel.commands = *file.commands;
  if (file.allow) panel.allow = *file.allow;
  if (file.low_word_first) panel.format.low_word_first = *file.low_word_first;
  if (file.infinity) panel.format.infinity = static_cast<float>(*file.infinity);
  if (!flag.empty() && !parse_address(flag, panel.host, panel.port)) {
    throw ToolError(fmt::format("--panel {}: is not an address; use HOST:PORT, for example 127.0.0.1:1503", flag));
  }
  return panel;
}

/// The token in a file: its first line.
std::string read_token(const std::string& path) {
  std::ifstream file(path);
  std::string token;
  if (!std::getline(file, token)) {
    throw ToolError(
        fmt::format("panel.http_token_file {}: cannot be read; write a token of {} characters or more there", path,
                    kShortestToken));
  }
  if (token.ends_with('\r')) token.pop_back();
  if (token.size() < kShortestToken || token.find_first_of(" \t") != std::string::npos) {
    throw ToolError(
        fmt::format("panel.http_token_file {}: its first line must be a token of {} characters or more without blanks",
                    path, kShortestToken));
  }
  return token;
}

/// The web panel, where one is asked for.
std::optional<WebSettings> plan_web(const PanelSettings& file, const std::string& flag) {
  const std::string address = flag.empty() ? file.http.value_or("") : flag;
  if (address.empty()) return std::nullopt;
  const char* const name = flag.empty() ? "panel.http" : "--http";
  WebSettings web;
  if (!parse_address(address, web.host, web.port)) {
    throw ToolError(fmt::format("{} {}: is not an address; use HOST:PORT, for example 127.0.0.1:8080", name, address));
  }
  if (file.allow) web.allow = *file.allow;
  if (file.http_token_file) web.token = read_token(*file.http_token_file);
  if (!WebPanel::has_page()) {
    throw ToolError(fmt::format(
        "{} {}: this program was built without the web panel; install Node.js (tools/install.sh) and build it "
        "again where npm's registry is reached, or leave this out",
        name, address));
  }
  return web;
}

/// Standard input can be read once.
void check_standard_input(const SourceSettings& source, const std::string& plan_file) {
  const auto* const replay = std::get_if<ReplaySettings>(&source);
  if (replay == nullptr || replay->file != "-" || plan_file != "-") return;
  throw ToolError(
      "--plan -: the recording is read from standard input too; name a file for one of them, or leave the plan "
      "out: a recording says how many points come");
}

/// A recording is read before the session begins: what is wrong with it is said at once, and what of it is not used.
void check_recording(const SourceSettings& source, FitPlan& plan) {
  const auto* const replay = std::get_if<ReplaySettings>(&source);
  if (replay == nullptr || replay->file == "-") return;
  const PointsFile file = read_points_csv(replay->file, replay->format);
  if (file.error) throw ToolError(file.error);
  for (const std::string& note : file.notes) plan.note += note + "\n";
}

/// A folder of its own for every session that has no name, so that none is resumed by accident.
std::string new_session_name() { return fmt::format("session-{:%Y%m%d-%H%M%S}", fmt::localtime(std::time(nullptr))); }

std::chrono::milliseconds idle_of(const SessionSettings& session) {
  const double seconds = session.until_idle.value_or(0);
  if (session.until_idle && (!(seconds > 0) || seconds > kLongestIdle_s)) {
    throw ToolError(fmt::format("--until-idle {}: give seconds above 0", seconds));
  }
  return std::chrono::milliseconds(std::llround(seconds * kMillisecondsPerSecond));
}

/// The number of points that will come: as it is given, or counted in a file of points; 0 = nothing says.
std::uint32_t planned_points(const PointPlan& plan, const PointsFormat& format) {
  if (plan.file.empty()) return plan.count;
  const PointsFile file = read_points_csv(plan.file, format);
  if (file.error) throw ToolError(file.error);
  return static_cast<std::uint32_t>(file.points.size());
}

/// The files that a session is made from, each with what it is.
FileRoles inputs_of(const RunFlags& flags, const SessionSettings& session, const SourceSettings& source) {
  const auto* const replay = std::get_if<ReplaySettings>(&source);
  return {{"design", session.design.value_or("")},
          {"session file", flags.config},
          {"device file", session.device.value_or("")},
          {"start pairs", start_file_of(session.fit)},
          {"zones", session.fit.zones_file},
          {"planned points", session.plan.value_or(PointPlan{}).file},
          {"recording", replay != nullptr ? replay->file : ""}};
}

/// Nothing that is written may take the place of what is read, nor the copy of the result that of a file of the
/// session. In the place of the session's own result.json it does no harm.
void check_outputs(const RunFlags& flags, const SessionSettings& session, const RunPlan& plan) {
  const std::filesystem::path folder(plan.host.session_directory);
  const std::filesystem::path copy(flags.json == "-" ? "" : flags.json);
  refuse_overwriting(copy, "journal of the session", folder / kJournalFile);
  refuse_overwriting(copy, "settings of the session", folder / kSettingsFile);
  refuse_overwriting(copy, "verdicts of the session", folder / kVerdictsFile);
  refuse_overwriting(copy, "record of the session", folder / kRecordFile);
  refuse_overwriting(copy, "design of the session", folder / kDesignFile);
  for (const auto& [what, input] : inputs_of(flags, session, plan.source)) {
    refuse_overwriting(copy, what, input);
    for (const char* name : {kJournalFile, kSettingsFile, kVerdictsFile, kResultFile, kRecordFile, kDesignFile})
      refuse_overwriting(folder / name, what, input);
  }
}

}  // namespace

RunPlan plan_run(const RunFlags& flags) {
  const SessionSettings session = merged_session(flags);
  if (!session.design) {
    throw ToolError("no design is given; name it with --design, or in the session file with --config");
  }
  RunPlan plan;
  plan.design = load_design(*session.design, design_choice_of(session.fit));
  if (const Status status = DesignImage::open(plan.design.image, plan.image); status != Status::ok) {
    throw ToolError(fmt::format("{}: {}", *session.design, status_text(status)));
  }
  plan.fit = plan_fit(session.fit, plan.image);
  if (plan.fit.search_start) {
    throw ToolError(
        "--start search: only localize can search, once all points are there; give a file of pairs, or leave it out");
  }
  if (session.capacity) plan.fit.localizer.capacity = *session.capacity;
  plan.source = plan_source(session, flags.session.fit, plan.fit.points);
  check_standard_input(plan.source, session.plan.value_or(PointPlan{}).file);
  check_recording(plan.source, plan.fit);
  plan.json = flags.json;
  plan.volume = flags.volume;
  // The screen would mix with the result.
  plan.headless = session.headless.value_or(false) || plan.json == "-";
  plan.host.localizer = plan.fit.localizer;
  plan.host.axis = plan.fit.axis;
  plan.host.tip_radius_mm =
      plan.fit.tip_radius_mm > 0 ? plan.fit.tip_radius_mm : tip_radius_of(Surface(plan.image), plan.fit.axis);
  plan.host.source_name = source_name(plan.source);
  plan.host.session_directory = session.session.value_or(new_session_name());
  plan.host.panel = plan_panel(session.panel, flags.panel);
  plan.web = plan_web(session.panel, flags.http);
  plan.host.feed = plan.web.has_value();
  plan.linger = std::chrono::milliseconds(std::llround(session.panel.linger.value_or(0) * kMillisecondsPerSecond));
  plan.host.idle = idle_of(session);
  plan.host.planned = planned_points(session.plan.value_or(PointPlan{}), plan.fit.points);
  const bool recording = std::holds_alternative<ReplaySettings>(plan.source);
  plan.host.end_when_finished = recording || plan.headless || session.until_idle.has_value();
  check_outputs(flags, session, plan);
  plan.report = session.report;
  plan.files = inputs_of(flags, session, plan.source);
  return plan;
}

}  // namespace bladefit
