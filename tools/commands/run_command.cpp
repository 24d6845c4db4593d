#include "tools/commands/run_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "drivers/make_source.hpp"
#include "drivers/source_registry.hpp"
#include "drivers/source_uri.hpp"
#include "tools/commands/design_notes.hpp"
#include "tools/commands/fit_flags.hpp"
#include "tools/commands/run_conclusion.hpp"
#include "tools/commands/run_plan.hpp"
#include "tools/commands/run_stop_flag.hpp"
#include "tools/commands/session_recorder.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/message.hpp"
#include "tools/panel/panel_display.hpp"
#include "tools/results/session_files.hpp"
#include "tools/web/design_json.hpp"
#include "tools/web/web_access.hpp"
#include "tools/web/web_panel.hpp"

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

/// Where others find the panel of this session.
std::string panel_address(const RunPlan& plan, const Host& host) {
  return fmt::format("{}:{}", plan.host.panel.host, host.panel_port());
}

/// Serves the page of the web panel, where one is wanted. After the start of the host.
void open_web(const RunPlan& plan, Host& host, WebPanel& web) {
  if (!plan.web) return;
  WebSource source{
      .state = [&host] { return host.panel_state(); },
      .feed = host.feed(),
      .press = [&host](const PanelCommands& commands) { host.press(commands); },
      .design = design_json(Surface(plan.image), plan.host.localizer.tolerance, plan.host.axis, plan.host.tip_radius_mm,
                            std::filesystem::path(plan.host.session_directory).filename().string())};
  if (const Failure failure = web.open(*plan.web, std::move(source))) throw ToolError(failure);
  if (!is_loopback(plan.web->host)) {
    tell(fmt::format("{}: other machines can reach this page, and nothing is encrypted; panel.allow limits who may ask",
                     web.address()));
  }
}

/// ", web panel at http://127.0.0.1:8080/"; empty where there is none.
std::string web_address(const RunPlan& plan, const WebPanel& web) {
  return plan.web ? fmt::format(", web panel at {}", web.address()) : "";
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
  const RunWords words(plan.json == "-" ? stderr : stdout);
  StepClock clock(plan.volume);
  if (!plan.volume.quiet) {
    tell_notes(plan.design, words.file);
    fmt::print(words.file, "{}", plan.fit.note);
  }

  const StopFlag stop;
  Notices notices(plan.headless);
  const std::unique_ptr<ProbeSource> source = make_source(plan.source);
  Host host(plan.host, plan.image, *source, [&notices](const std::string& line) { notices.add(line); });
  if (const Failure failure = host.start()) throw ToolError(failure);
  WebPanel web;
  open_web(plan, host, web);
  for (const std::string& part : stray_parts(plan))
    tell(fmt::format("{}: left by a run that was killed; removed", part));
  SessionRecorder recorder(plan);
  const std::string begun = fmt::format("Points from {}, session in {}, panel at {}{}\n", source_name(plan.source),
                                        plan.host.session_directory, panel_address(plan, host), web_address(plan, web));
  if (!plan.volume.quiet) std::fputs(begun.c_str(), words.file);
  clock.done("session begun");
  std::fflush(words.file);
  watch(host, plan, stop, recorder);
  clock.done("points taken");
  notices.flush();
  const int exit_code = conclude_run(plan, host, words, recorder);
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
  command.add_option("--http", flags.http,
                     "HOST:PORT to serve the web panel at (off unless set; for example 127.0.0.1:8080, port 0: any)");
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
