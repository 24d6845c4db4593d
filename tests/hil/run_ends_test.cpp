// Sessions that end in another way than by the machine's program: what is on disk then, and what is told.
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// A command line for a shell.
std::string joined(const std::vector<std::string>& arguments) {
  std::string line;
  for (const std::string& argument : arguments) line += "'" + argument + "' ";
  return line;
}

std::vector<std::string> replay(const ScratchFolder& scratch, const std::vector<std::string>& more = {"--headless"}) {
  return run_options("replay:" + kFewPoints, scratch / "session", scratch / "result.json", more);
}

TEST(RunEnds, WithTheResultWhenItsTerminalIsClosed) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "200"}));
  Process run(run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json",
                          {"--headless"}));
  ASSERT_TRUE(wait_for_points(run, 150)) << run.err();
  run.signal(SIGHUP);
  const std::optional<int> exit_code = run.exit_code(20s);
  const std::string json = read_whole(scratch / "session/result.json");
  ASSERT_FALSE(json.empty()) << run.err();
  EXPECT_EQ(exit_code, expected_exit(json));
}

/// The terminal itself goes, with a screen on it.
TEST(RunEnds, WithTheResultWhenTheTerminalOfItsScreenIsGone) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "200"}));
  const std::vector<std::string> options =
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json");
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (pid == 0) {
    setenv("TERM", "xterm", 1);
    std::vector<char*> pointers;
    for (const std::string& option : options) pointers.push_back(const_cast<char*>(option.c_str()));
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  std::array<char, 4096> bytes{};
  std::string shown;
  while (shown.find("probe next") == std::string::npos) {
    const ssize_t count = read(terminal, bytes.data(), bytes.size());
    ASSERT_GT(count, 0) << shown;
    shown.append(bytes.data(), static_cast<std::size_t>(count));
  }
  close(terminal);
  int status = 0;
  ASSERT_EQ(waitpid(pid, &status, 0), pid);
  ASSERT_TRUE(WIFEXITED(status)) << "a signal ended it";
  const std::string json = read_whole(scratch / "result.json");
  ASSERT_FALSE(json.empty());
  EXPECT_EQ(WEXITSTATUS(status), expected_exit(json));
}

TEST(RunEnds, WithTheResultWhenNobodyReadsItsOutput) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "200"}));
  const std::vector<std::string> options =
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json");
  Process run({"bash", "-c", joined(options) + "| head -n 3; exit ${PIPESTATUS[0]}"});
  const std::optional<int> exit_code = run.exit_code(30s);
  const std::string json = read_whole(scratch / "result.json");
  ASSERT_FALSE(json.empty()) << run.err();
  EXPECT_LT(testing::parse_json(json).at("points").size(), 2000U);
  EXPECT_EQ(exit_code, expected_exit(json)) << run.err();
  EXPECT_NE(run.err().find("the summary cannot be written"), std::string::npos) << run.err();
}

/// A limit on the size of files stands for a full disk: the design, the journal and verdicts.csv are below it,
/// result.json is not.
TEST(RunEnds, EveryOtherFileAndTheSummaryAreWrittenOnAFullDisk) {
  const ScratchFolder scratch;
  Process run({"bash", "-c",
               "ulimit -f 500; exec " + joined(run_options("replay:" + kAllPoints, scratch / "session",
                                                           scratch / "result.json", {"--headless"}))});
  EXPECT_EQ(run.exit_code(), 3) << run.err();
  EXPECT_NE(run.err().find("result.json: cannot be written"), std::string::npos) << run.err();
  EXPECT_NE(run.out().find("Verdict: "), std::string::npos) << run.out();
  EXPECT_NE(run.out().find("Written: " + (scratch / "session/verdicts.csv")), std::string::npos) << run.out();
  EXPECT_FALSE(read_whole(scratch / "session/verdicts.csv").empty());
}

TEST(RunEnds, WithTheVerdictToldAndFilesMissingWhenItsFolderIsRemoved) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "200"}));
  Process run(run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json",
                          {"--headless"}));
  ASSERT_TRUE(wait_for_points(run, 150)) << run.err();
  std::filesystem::remove_all(scratch / "session");
  EXPECT_EQ(run.exit_code(20s), 3) << run.out();
  EXPECT_NE(run.err().find("journal.bin: was removed during the session"), std::string::npos) << run.err();
  EXPECT_NE(run.out().find("by a fault; what follows is of the "), std::string::npos) << run.out();
  EXPECT_GE(testing::parse_json(read_whole(scratch / "result.json")).at("points").size(), 100U);
}

TEST(RunEnds, PartsThatAKilledRunLeftAreRemovedAndNamed) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "session");
  const std::string dead = "999999999", alive = std::to_string(getppid());
  for (const std::string name : {"session/result.json", "session/verdicts.csv", "result.json"}) {
    std::ofstream(scratch / (name + ".partial-" + dead)) << "x";
  }
  std::ofstream(scratch / ("result.json.partial-" + alive)) << "x";
  Process run(replay(scratch));
  ASSERT_TRUE(run.exit_code()) << run.err();
  for (const std::string name : {"session/result.json", "session/verdicts.csv", "result.json"}) {
    const std::string part = scratch / (name + ".partial-" + dead);
    EXPECT_FALSE(std::filesystem::exists(part)) << part;
    EXPECT_NE(run.err().find(part + ": left by a run that was killed; removed"), std::string::npos) << run.err();
  }
  EXPECT_TRUE(std::filesystem::exists(scratch / ("result.json.partial-" + alive)));
}

}  // namespace
}  // namespace bladefit::hil
