// Missing, busy and foreign devices: one line that names the device and the fix, exit code 3 (2 for a recording that
// cannot be used), no result left behind.
#include <gtest/gtest.h>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// Runs a session to its end and expects a failure told in one line with these words.
void expect_failure(int exit_code, const std::string& source, const std::vector<std::string>& words) {
  SCOPED_TRACE(source);
  const ScratchFolder scratch;
  Process run(run_options(source, scratch / "session", scratch / "result.json", kUntilIdle));
  EXPECT_EQ(run.exit_code(30s), exit_code) << run.out();
  const std::string line = run.err();
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  for (const std::string& word : words) EXPECT_NE(line.find(word), std::string::npos) << line;
  EXPECT_FALSE(std::filesystem::exists(scratch / "result.json"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "session")) << "an empty session is left behind";
}

void expect_device_failure(const std::string& source, const std::vector<std::string>& words) {
  expect_failure(3, source, words);
}

TEST(RunRefusals, ARecordingThatIsNotThere) { expect_failure(2, "replay:nowhere.csv", {"nowhere.csv: no such file"}); }

TEST(RunRefusals, NobodyListensAtThePort) { expect_device_failure("modbus-tcp://127.0.0.1:1", {"127.0.0.1:1"}); }

TEST(RunRefusals, TheDeviceDoesNotExist) {
  expect_device_failure("modbus-rtu:/nowhere/cmm", {"/nowhere/cmm"});
  expect_device_failure("serial:/nowhere/cmm", {"/nowhere/cmm"});
}

TEST(RunRefusals, AFolderThatWasThereStays) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "mine");
  const std::string source = "modbus-tcp://127.0.0.1:1";
  Process there(run_options(source, scratch / "mine", scratch / "result.json", kUntilIdle));
  EXPECT_EQ(there.exit_code(30s), 3);
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "mine"));
  Process deep(run_options(source, scratch / "mine/deep/session/", scratch / "result.json", kUntilIdle));
  EXPECT_EQ(deep.exit_code(30s), 3);
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "mine"));
}

TEST(RunRefusals, AnotherMapVersion) {
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--map-version", "2"}));
  expect_device_failure(source_of(Link::modbus_tcp, machine.address()), {machine.address(), "version 2"});
}

TEST(RunRefusals, TheDeviceIsBusy) {
  for (const Link link : {Link::modbus_rtu, Link::serial}) {
    const ScratchFolder scratch;
    SimulatedMachine machine(machine_options(link, scratch / "cmm", kAllPoints, {"--rate", "100"}));
    const std::string source = source_of(link, machine.address());
    Process first(run_options(source, scratch / "session", scratch / "result.json"));
    ASSERT_TRUE(wait_for_points(first, 10)) << first.err();
    expect_device_failure(source, {"cmm", "busy"});
    EXPECT_TRUE(first.running());
  }
}

TEST(RunRefusals, ThePanelsPortIsBusy) {
  SimulatedMachine other(machine_options(Link::modbus_tcp, "0", kFewPoints));
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints));
  const ScratchFolder scratch;
  Process run({BLADEFIT_COMMAND, "run", "--design", kBlade, "--source", source_of(Link::modbus_tcp, machine.address()),
               "--leading-edge", "u:0.4:0.6", "--tolerance", "0.1", "--session", scratch / "session", "--panel",
               other.address(), "--headless"});
  EXPECT_EQ(run.exit_code(20s), 3);
  EXPECT_NE(run.err().find(other.address()), std::string::npos) << run.err();
}

}  // namespace
}  // namespace bladefit::hil
