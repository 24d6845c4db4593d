// The screen in real terminals of three sizes, driven by keys: tmux holds the terminals and tells what they show.
#include <gtest/gtest.h>

#include <unistd.h>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// A command in a terminal of its own.
class Pane {
 public:
  Pane(int width, int height, const std::vector<std::string>& command)
      : server_("bladefit-" + std::to_string(getpid()) + "-" + std::to_string(++count_)) {
    // Its own answer to a missing configuration is quiet; the pane stays when the command has ended.
    tmux(std::vector<std::string>{"-f", "/dev/null", "-u", "new-session", "-d", "-x", std::to_string(width), "-y",
                                  std::to_string(height), "-e", "LC_ALL=C.UTF-8", "-e", "NO_COLOR="} +
         command);
    tmux({"set-option", "-g", "remain-on-exit", "on"});
  }
  ~Pane() { tmux({"kill-server"}); }
  Pane(const Pane&) = delete;
  Pane& operator=(const Pane&) = delete;

  [[nodiscard]] std::string shown() const { return tmux({"capture-pane", "-p"}); }
  /// What it shows and what has scrolled away above.
  [[nodiscard]] std::string all_lines() const { return tmux({"capture-pane", "-p", "-S", "-"}); }
  void press(const std::string& key) const { tmux({"send-keys", key}); }

  [[nodiscard]] bool shows(const std::string& words) const {
    return eventually([&] { return shown().find(words) != std::string::npos; }, 20s);
  }
  [[nodiscard]] bool has_ended() const {
    return eventually([&] { return tmux({"display-message", "-p", "#{pane_dead}"}).starts_with("1"); }, 10s);
  }

 private:
  std::string tmux(const std::vector<std::string>& arguments) const {
    Process process(std::vector<std::string>{"tmux", "-L", server_} + arguments);
    return process.exit_code(10s) ? process.out() : std::string();
  }

  static inline int count_ = 0;
  std::string server_;
};

TEST(ScreenPanes, FitThreeSizesAndFollowKeys) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "0"}));
  const Process host(run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session",
                                 scratch / "result.json", {"--plan", "200"}));
  const std::string address = "127.0.0.1:" + std::to_string(panel_port(host));
  for (const auto& [width, height] : {std::pair{60, 15}, {80, 24}, {120, 40}}) {
    const Pane pane(width, height, {BLADEFIT_COMMAND, "panel", "--connect", address});
    ASSERT_TRUE(pane.shows("200 of 200")) << pane.shown();
    ASSERT_TRUE(pane.shows("session settled")) << pane.shown();
    for (const char* words :
         {"OUT OF TOLERANCE", "mm CUT", "leading edge", "cut or weld the points marked", "root 0.2", "q leaves", "█"}) {
      EXPECT_TRUE(pane.shows(words)) << words << " at " << width << "\n" << pane.shown();
    }
    pane.press("e");
    EXPECT_TRUE(pane.shows("degrees of freedom known")) << pane.shown();
    pane.press("e");
    EXPECT_TRUE(pane.shows("r/R from-to")) << pane.shown();
    pane.press("q");
    EXPECT_TRUE(pane.has_ended()) << pane.shown();
  }
}

TEST(ScreenPanes, BigLettersAndASilentHost) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "0"}));
  Process host(
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json"));
  const Pane pane(80, 24,
                  {BLADEFIT_COMMAND, "panel", "--big", "--connect", "127.0.0.1:" + std::to_string(panel_port(host))});
  ASSERT_TRUE(pane.shows("██"));
  pane.press("b");
  ASSERT_TRUE(pane.shows("200")) << pane.shown();
  host.signal(SIGKILL);
  EXPECT_TRUE(pane.shows("NO ANSWER from 127.0.0.1")) << pane.shown();
  EXPECT_NE(pane.shown().find("200"), std::string::npos) << "the last numbers stay, marked as old";
}

/// The session's own screen has no key that ends the session by mistake.
TEST(ScreenPanes, TheSessionsOwnScreenEndsByCtrlCAlone) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "50"}));
  const Pane pane(
      80, 24,
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json"));
  ASSERT_TRUE(pane.shows("Ctrl-C ends the session")) << pane.shown();
  pane.press("q");
  pane.press("e");
  EXPECT_TRUE(pane.shows("degrees of freedom known")) << pane.shown();
  pane.press("C-c");
  EXPECT_TRUE(pane.has_ended()) << pane.shown();
  // A session cut off early has more reasons than the pane has lines, so the verdict may be above it.
  EXPECT_NE(pane.all_lines().find("Verdict: not_decided"), std::string::npos) << pane.all_lines();
}

}  // namespace
}  // namespace bladefit::hil
