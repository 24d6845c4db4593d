#include "tools/commands/run_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "drivers/make_source.hpp"
#include "drivers/source_registry.hpp"
#include "drivers/source_uri.hpp"
#include "tools/batch/batch_fit.hpp"
#include "tools/commands/design_notes.hpp"
#include "tools/commands/fit_flags.hpp"
#include "tools/commands/run_plan.hpp"
#include "tools/commands/run_stop_flag.hpp"
#include "tools/commands/session_recorder.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/message.hpp"
#include "tools/files/output_file.hpp"
#include "tools/panel/panel_display.hpp"
#include "tools/results/json_writer.hpp"
#include "tools/results/operator_summary.hpp"
#include "tools/results/session_files.hpp"

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kTurn{50};

/// Lines that the host has for the user. They wait while a screen is shown.
class Notices {
 public:
  explicit Notices(bool at_once) : at_once_(at_once) {}

  void add(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (at_once_) {
      tell(line);
    } else {
      waiting_.push_back(line);
    }
  }

  void flush() {
    const std::lock_guard lock(mutex_);
    for (const std::string& line : waiting_) tell(line);
    waiting_.clear();
  }

 private:
  bool at_once_;
  std::mutex mutex_;
  std::vector<std::string> waiting_;
};

int exit_code_of(const Failure& failure) { return ToolError(failure).exit_code(); }

/// Where others find the panel of this session.
std::string panel_address(const RunPlan& plan, const Host& host) {
  return fmt::format("{}:{}", plan.host.panel.host, host.panel_port());
}

void watch(Host& host, const RunPlan& plan, const StopFlag& stop, SessionRecorder& recorder) {
  std::optional<PanelDisplay> display;
  if (!plan.headless) {
    display.emplace(panel_address(plan, host), [&host](PanelState& state) {
      state = host.panel_state();
      return Failure{};
    });
  }
  while (!host.wait_for_end(kTurn)) {
    recorder.turn();
    if (display) display->turn();
    if (stop.requested() || (display && display->is_cut_off())) host.request_stop();
  }
}

/// Keeps the panel of an ended session as long as the settings say, for those who look at it; a signal ends it.
void linger(const RunPlan& plan, const StopFlag& stop, std::uint16_t port, std::FILE* words) {
  if (plan.linger.count() == 0 || stop.requested()) return;
  const std::string text = fmt::format("The panel at {}:{} shows the result for {} s; Ctrl-C ends\n",
                                       plan.host.panel.host, port, std::chrono::duration<double>(plan.linger).count());
  std::fputs(text.c_str(), words);
  std::fflush(words);
  const auto until = std::chrono::steady_clock::now() + plan.linger;
  while (!stop.requested() && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(kTurn);
}

/// The points of the ended session.
struct SessionPoints : JudgedPoints {
  void add(const ProbePoint& point, const Verdict& verdict) override { rows.push_back({point, verdict}); }
  void clear() override { rows.clear(); }
  Rows<JudgedPoint> rows;
};

std::string ending(const SessionResult& session, std::size_t points) {
  switch (session.end) {
    case SessionEnd::finished:
      return "the machine's program is finished";
    case SessionEnd::idle:
      return "no new point came";
    case SessionEnd::stopped:
      return "stopped";
    case SessionEnd::running:
    case SessionEnd::failed:
      break;
  }
  return fmt::format("by a fault; what follows is of the {} points stored before it", points);
}

/// Where the words for the user go.
struct Words {
  explicit Words(std::FILE* to) : file(to), terminal(isatty(fileno(to)) == 1) {}
  std::FILE* file;
  bool terminal;
};

/// Tells the end of the session. Returns false where the output fails; one that nobody reads any more, a pipe or a
/// terminal that is gone, was given up by its reader, and is none of our failures.
bool tell_summary(const Words& words, const std::string& text, const RunPlan& plan) {
  std::clearerr(words.file);
  errno = 0;
  const bool told = std::fputs(text.c_str(), words.file) >= 0 && std::fflush(words.file) == 0;
  if (told) return true;
  const int reason = errno;
  tell(fmt::format("the summary cannot be written ({}); the result is in {}", std::strerror(reason),
                   plan.host.session_directory));
  const bool given_up = reason == EPIPE || (words.terminal && reason == EIO);
  if (given_up) std::clearerr(words.file);
  return given_up;
}

WrittenFiles write_files(const RunPlan& plan, const Result& result) {
  WrittenFiles files = write_session_files(plan.host.session_directory, result);
  if (plan.json.empty()) return files;
  const auto json = [&result](const Put& put) { write_result_json(result, put); };
  add_written(
      plan.json, [&] { write_output(plan.json, json); }, files);
  return files;
}

/// Writes what the session came to, also after a fault: then of the points stored before it. Whatever cannot be written
/// keeps nothing else from it.
int conclude(const RunPlan& plan, Host& host, const Words& words, SessionRecorder& recorder) {
  SessionPoints points;
  const SessionResult session = host.finish(points);
  if (session.error) tell(session.error.message);
  // A session that was refused is not this run's to report on.
  const bool refused = session.error.kind == Failure::Kind::bad_input;
  if (session.error && (refused || points.rows.empty())) return exit_code_of(session.error);
  const StreamEvidence stream{session.lost, session.losses.unnumbered(), session.refused, session.losses.finished()};
  if (points.rows.empty()) {
    throw ToolError(
        fmt::format("the session in {} has no point that can be used: nothing can be said of the blade; "
                    "check that the machine's program is running",
                    plan.host.session_directory));
  }
  Result result = result_of(plan.image, plan.fit, points.rows, session.report, stream, plan.host.session_directory);
  recorder.turn();
  result.record = recorder.record();
  result.record->ended = utc_now();
  host.conclude({result.verdict.state, result.verdict.codes()});
  const WrittenFiles files = write_files(plan, result);
  std::string text = told_of(operator_summary(result), plan.volume);
  if (!plan.volume.quiet) text.insert(0, fmt::format("Session ended: {}\n", ending(session, points.rows.size())));
  for (const std::string& path : files.paths)
    text += path == "-" || plan.volume.quiet ? "" : fmt::format("Written: {}\n", path);
  const bool told = tell_summary(words, text, plan);
  for (const Failure& failure : files.failures) tell(failure.message);
  if (session.error) return exit_code_of(session.error);
  if (!files.failures.empty()) return exit_code_of(files.failures.front());
  return told ? exit_code_of(result) : kDeviceFailure;
}

/// Removes what killed runs left of the files of this one. The session is locked: nobody else writes them now.
std::vector<std::string> stray_parts(const RunPlan& plan) {
  std::vector<std::string> parts = remove_stray_session_files(plan.host.session_directory);
  if (plan.json.empty() || plan.json == "-") return parts;
  const std::vector<std::string> copies = remove_stray_parts(plan.json);
  parts.insert(parts.end(), copies.begin(), copies.end());
  return parts;
}

int run(const RunFlags& flags) {
  const RunPlan plan = plan_run(flags);
  const Words words(plan.json == "-" ? stderr : stdout);
  StepClock clock(plan.volume, words.file);
  if (!plan.volume.quiet) {
    tell_notes(plan.design, words.file);
    fmt::print(words.file, "{}", plan.fit.note);
  }

  const StopFlag stop;
  Notices notices(plan.headless);
  const std::unique_ptr<ProbeSource> source = make_source(plan.source);
  Host host(plan.host, plan.image, *source, [&notices](const std::string& line) { notices.add(line); });
  if (const Failure failure = host.start()) throw ToolError(failure);
  for (const std::string& part : stray_parts(plan))
    tell(fmt::format("{}: left by a run that was killed; removed", part));
  SessionRecorder recorder(plan);
  const std::string begun = fmt::format("Points from {}, session in {}, panel at {}\n", source_name(plan.source),
                                        plan.host.session_directory, panel_address(plan, host));
  if (!plan.volume.quiet) std::fputs(begun.c_str(), words.file);
  clock.done("session begun");
  std::fflush(words.file);
  watch(host, plan, stop, recorder);
  clock.done("points taken");
  notices.flush();
  const int exit_code = conclude(plan, host, words, recorder);
  clock.done("result written");
  if (exit_code != kBadInput) linger(plan, stop, host.panel_port(), words.file);
  return exit_code;
}

void add_session_options(CLI::App& command, RunFlags& flags) {
  const auto text = [&command](const char* name, std::optional<std::string>& target, const char* help) {
    command.add_option_function<std::string>(
        name, [&target](const std::string& value) { target = value; }, help);
  };
  SessionSettings& session = flags.session;
  command.add_option("--config", flags.config,
                     "session TOML (see config/session.toml); options given here win over it");
  text("--design", session.design, "design: .igs .iges .stp .step, or .bfd from `bladefit compile`");
  text("--source", session.source, source_uri_forms().c_str());
  text("--session", session.session, "folder of the journal and the results; a session in it is resumed");
  command.add_option("--panel", flags.panel, "HOST:PORT to serve the panel at (default 127.0.0.1:1503; port 0: any)");
  command.add_flag_callback(
      "--headless", [&session] { session.headless = true; }, "no screen; ends when the machine's program is finished");
  command.add_option_function<double>(
      "--until-idle", [&session](double value) { session.until_idle = value; },
      "end when the program is finished or no new point came for so many seconds");
  command.add_option_function<std::string>(
      "--plan",
      [&session](const std::string& plan) {
        if (const Failure failure = parse_point_plan(plan, session.plan.emplace()))
          throw ToolError("--plan " + failure.message);
      },
      "how many points will come, or a CSV file of those that the program will probe: the panel then "
      "says how far it is");
  command.add_option("--json", flags.json, "write a copy of result.json here; - writes it to standard output");
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<RunFlags>();
  CLI::App* command = app.add_subcommand("run", "a live session: take points from a machine, fit and judge them");
  command->footer(
      "\nExamples:\n"
      "  bladefit run --design blade.bfd --source modbus-tcp://192.168.0.10:502 --leading-edge u:0.4:0.6 "
      "--tolerance 0.1mm --session monday --plan points.csv\n"
      "  bladefit run --config session.toml --headless --json result.json");
  add_session_options(*command, *flags);
  add_volume_flags(*command, flags->volume);
  add_fit_options(*command, flags->session.fit);
  command->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace bladefit
