#include "tools/commands/run_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>

#include "drivers/make_source.hpp"
#include "drivers/source_registry.hpp"
#include "drivers/source_uri.hpp"
#include "tools/batch/batch_fit.hpp"
#include "tools/commands/design_notes.hpp"
#include "tools/commands/run_plan.hpp"
#include "tools/commands/run_stop_flag.hpp"
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
      print(line);
    } else {
      waiting_.push_back(line);
    }
  }

  void flush() {
    const std::lock_guard lock(mutex_);
    for (const std::string& line : waiting_) print(line);
    waiting_.clear();
  }

 private:
  static void print(const std::string& line) { fmt::print(stderr, "bladefit: {}\n", one_line(line)); }

  bool at_once_;
  std::mutex mutex_;
  std::vector<std::string> waiting_;
};

/// Says it and goes on: what was stored before it is still reported on.
void report(const Failure& failure) { fmt::print(stderr, "bladefit: {}\n", one_line(failure.message)); }

int exit_code_of(const Failure& failure) { return ToolError(failure).exit_code(); }

/// The panel of this session as this machine reaches it.
PanelClient own_panel(const PanelServerSettings& settings, std::uint16_t port) {
  const bool any_address = settings.host == "0.0.0.0" || settings.host == "::";
  return {any_address ? "localhost" : settings.host, port};
}

void watch(Host& host, const RunPlan& plan) {
  const StopFlag stop;
  std::optional<PanelDisplay> display;
  if (!plan.headless) display.emplace(own_panel(plan.host.panel, host.panel_port()));
  while (!host.wait_for_end(kTurn)) {
    if (stop.requested()) host.request_stop();
    if (display) display->turn();
  }
}

std::string ending(const SessionResult& session) {
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
  return fmt::format("by a fault; what follows is of the {} points stored before it", session.points.size());
}

/// Writes what the session came to, also after a fault: then of the points stored before it.
int conclude(const RunPlan& plan, const SessionResult& session, std::FILE* words) {
  if (session.error) report(session.error);
  // A session that was refused is not this run's to report on.
  const bool refused = session.error.kind == Failure::Kind::bad_input;
  if (session.error && (refused || session.points.empty())) return exit_code_of(session.error);
  const StreamEvidence stream{session.lost, session.losses.unnumbered(), session.refused, session.losses.finished()};
  if (session.points.empty()) {
    throw ToolError(
        fmt::format("the session in {} has no point that can be used: nothing can be said of the blade; "
                    "check that the machine's program is running",
                    plan.host.session_directory));
  }
  const Result result = result_of(plan.image, plan.fit, session.points, session.report, session.verdicts, stream,
                                  plan.host.session_directory);
  const std::vector<std::string> files = write_session_files(plan.host.session_directory, result);
  if (!plan.json.empty()) write_output(plan.json, result_json(result));
  fmt::print(words, "Session ended: {}\n{}", ending(session), operator_summary(result));
  for (const std::string& file : files) fmt::print(words, "Written: {}\n", file);
  if (!plan.json.empty() && plan.json != "-") fmt::print(words, "Written: {}\n", plan.json);
  return session.error ? exit_code_of(session.error) : exit_code_of(result);
}

int run(const RunFlags& flags) {
  const RunPlan plan = plan_run(flags);
  std::FILE* const words = plan.json == "-" ? stderr : stdout;
  tell_notes(plan.design, words);
  if (!plan.fit.note.empty()) fmt::print(words, "{}", plan.fit.note);

  Notices notices(plan.headless);
  const std::unique_ptr<ProbeSource> source = make_source(plan.source);
  Host host(plan.host, plan.image, *source, [&notices](const std::string& line) { notices.add(line); });
  if (const Failure failure = host.start()) throw ToolError(failure);
  fmt::print(words, "Points from {}, session in {}, panel at {}:{}\n", source_name(plan.source),
             plan.host.session_directory, plan.host.panel.host, host.panel_port());
  std::fflush(words);
  watch(host, plan);
  const SessionResult session = host.finish();
  notices.flush();
  return conclude(plan, session, words);
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
  command.add_option("--json", flags.json, "write a copy of result.json here; - writes it to standard output");
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<RunFlags>();
  CLI::App* command = app.add_subcommand("run", "a live session: take points from a machine, fit and judge them");
  add_session_options(*command, *flags);
  add_fit_options(*command, flags->session.fit);
  command->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace bladefit
