// What goes to a terminal, with and without NO_COLOR, and to anything else.
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>

#include <regex>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// A process on a terminal of its own; its output up to when `enough` is in it.
std::string on_a_terminal(const std::vector<std::string>& arguments, const std::string& enough) {
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (pid == 0) {
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  std::string output;
  const Clock::time_point until = Clock::now() + 10s;
  std::array<char, 4096> bytes{};
  bool interrupted = false;
  while (Clock::now() < until) {
    pollfd event{terminal, POLLIN, 0};
    if (poll(&event, 1, 100) <= 0) continue;
    const ssize_t count = read(terminal, bytes.data(), bytes.size());
    if (count <= 0) break;
    output.append(bytes.data(), static_cast<std::size_t>(count));
    if (!interrupted && output.find(enough) != std::string::npos) interrupted = kill(pid, SIGINT) == 0;
  }
  kill(pid, SIGKILL);
  waitpid(pid, nullptr, 0);
  close(terminal);
  return output;
}

bool has_colour(const std::string& output) { return std::regex_search(output, std::regex("\x1b\\[[0-9;]*m")); }

TEST(ScreenOutput, NoColorTakesTheColoursOut) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "100"}));
  const Process host(
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json"));
  const std::vector<std::string> panel = {BLADEFIT_COMMAND, "panel", "--connect",
                                          "127.0.0.1:" + std::to_string(panel_port(host))};
  const std::string enough = "q leaves";
  const std::vector<std::string> xterm = {"env", "TERM=xterm-256color"};
  const std::string plain = on_a_terminal(xterm + std::vector<std::string>{"NO_COLOR=1"} + panel, enough);
  const std::string unset =
      on_a_terminal(std::vector<std::string>{"env", "-u", "NO_COLOR", "TERM=xterm-256color"} + panel, enough);
  const std::string empty = on_a_terminal(xterm + std::vector<std::string>{"NO_COLOR="} + panel, enough);
  for (const std::string& output : {plain, unset, empty}) EXPECT_NE(output.find(enough), std::string::npos) << output;
  EXPECT_FALSE(has_colour(plain));
  EXPECT_TRUE(has_colour(unset));
  EXPECT_TRUE(has_colour(empty)) << "an empty NO_COLOR counts as none";
  EXPECT_TRUE(plain.ends_with("\x1b[?25h\x1b[?1049l")) << "the terminal is as it was";
}

TEST(ScreenOutput, ADumbTerminalGetsLines) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "100"}));
  const Process host(
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json"));
  const std::string output = on_a_terminal(
      {"env", "TERM=dumb", BLADEFIT_COMMAND, "panel", "--connect", "127.0.0.1:" + std::to_string(panel_port(host))},
      "link up");
  EXPECT_NE(output.find("link up"), std::string::npos) << output;
  EXPECT_EQ(output.find('\x1b'), std::string::npos) << output;
}

TEST(ScreenOutput, NoEscapeCodesWhereThereIsNoTerminal) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "100"}));
  Process run(run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json",
                          {"--until-idle", "3"}));
  EXPECT_EQ(run.exit_code(30s), 1) << run.err();
  EXPECT_NE(run.out().find("link up"), std::string::npos) << "no line of the panel was shown";
  EXPECT_EQ((run.out() + run.err()).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace bladefit::hil
