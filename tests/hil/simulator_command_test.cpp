// What `bladefit simulate` says and returns, and what it leaves behind.
#include <gtest/gtest.h>

#include "tests/hil/raw_readers.hpp"

namespace bladefit::hil {
namespace {

/// Runs the command to its end and expects one line on standard error that holds `words`.
void expect_refusal(const std::vector<std::string>& options, int exit_code, const std::string& words) {
  SCOPED_TRACE(words);
  Process process(std::vector<std::string>{BLADEFIT_COMMAND, "simulate"} + options);
  EXPECT_EQ(process.exit_code(5s), exit_code);
  const std::string line = process.err();
  EXPECT_NE(line.find(words), std::string::npos) << line;
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  EXPECT_EQ(process.out(), "");
}

std::vector<std::string> tcp(const std::vector<std::string>& more) {
  return std::vector<std::string>{"--points", kFewPoints, "--transport", "modbus-tcp"} + more;
}

TEST(SimulatorCommand, RefusesWrongOptions) {
  expect_refusal(tcp({"--port", "70000"}), 2, "--port 70000");
  expect_refusal(tcp({"--rate=-1"}), 2, "--rate -1");
  expect_refusal(tcp({"--rate", "nan"}), 2, "--rate nan");
  expect_refusal(tcp({"--capacity", "0"}), 2, "--capacity 0");
  expect_refusal(tcp({"--capacity", "4000"}), 2, "--capacity 4000");
  expect_refusal(tcp({"--faults", "drop=1.5"}), 2, "drop=1.5");
  expect_refusal(tcp({"--faults", "drop=0.1,fire=0.1"}), 2, "`fire=0.1`: is unknown");
  expect_refusal(tcp({"--faults", "delay=0.1:20s"}), 2, "delay=0.1:20s");
  expect_refusal(tcp({"--faults", "seed=x"}), 2, "seed=x");
  expect_refusal(tcp({"--stamp", "/nowhere/stamps"}), 2, "--stamp /nowhere/stamps");
  expect_refusal({"--points", kFewPoints, "--transport", "modbus-rtu", "--unit", "300"}, 2, "--unit 300");
}

TEST(SimulatorCommand, RefusesBadPoints) {
  ScratchFolder scratch;
  const std::string file = scratch / "points.csv";
  const auto expect_bad = [&](const std::string& content, const std::string& words) {
    std::ofstream(file) << content;
    expect_refusal({"--points", file, "--transport", "modbus-tcp", "--port", "0"}, 2, file + words);
  };
  expect_bad("", ": the file is empty");
  expect_bad("x,y,z\n# none\n", ": the list of points is empty");
  expect_bad("x,y\n1,2\n", ":1: column 'z' is missing");
  expect_bad("x,y,z,x\n1,2,3,4\n", ":1: column 'x' is named twice");
  expect_bad("x,y,z,i\n1,2,3,1\n", ":1: column 'j' is missing");
  expect_bad("x,y,z\n1,2,3\n1,2\n", ":3: 2 columns where 3 are named");
  expect_bad("x,y,z\n1,2,three\n", ":2: column z: 'three': is not a finite number");
  expect_bad("x,y,z\n1,nan,3\n", ":2: column y: 'nan': is not a finite number");
  expect_bad("x,y,z,i,j,k\n1,2,3,1,1,0\n", ":2: columns i,j,k: the direction has the length");
  expect_bad("x,y,z,path\n1,2,3,1.5\n", ":2: column path: '1.5' is not a whole number");
  expect_bad(std::string("\x7F"
                         "ELF\0\1\2",
                         7),
             ":1: a control character");
  expect_bad("x,y,z,weight\n1,2,3,0\n", ":2: column weight: '0' is not a number from 1e-09");
  expect_refusal({"--points", scratch / "none.csv", "--transport", "serial"}, 2, "none.csv: ");
}

TEST(SimulatorCommand, ServesTheWeightedPointsThatLocalizeAccepts) {
  ScratchFolder scratch;
  std::ofstream(scratch / "points.csv") << "x,y,z,path,weight\n1,2,3,4,0.25\n5,6,7,4,1\n";
  SimulatedMachine machine({"--points", scratch / "points.csv", "--transport", "modbus-tcp", "--port", "0"});
  const RawModbus reader = RawModbus::tcp(machine.port());
  reader.command(1);
  ASSERT_TRUE(eventually([&] { return reader.newest() == 2; }, 2s));
  EXPECT_EQ(reader.record(1).point.position, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(reader.record(2).point.position, (std::array<double, 3>{5, 6, 7}));
  EXPECT_EQ(reader.record(2).point.path, 4);
}

TEST(SimulatorCommand, AcceptsColumnsInAnyOrderCommentsAndForeignLineEnds) {
  ScratchFolder scratch;
  std::ofstream(scratch / "points.csv") << "# a comment\r\npath, z, y, x\r\n\r\n4, 3, 2, 1\r\n";
  SimulatedMachine machine({"--points", scratch / "points.csv", "--transport", "modbus-tcp", "--port", "0"});
  const RawModbus reader = RawModbus::tcp(machine.port());
  reader.command(1);
  ASSERT_TRUE(eventually([&] { return reader.newest() == 1; }, 2s));
  EXPECT_EQ(reader.record(1).point.position, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(reader.record(1).point.path, 4);
}

TEST(SimulatorCommand, ABusyPortOrDeviceIsADeviceFailure) {
  SimulatedMachine machine(tcp({"--port", "0"}));
  expect_refusal(tcp({"--port", std::to_string(machine.port())}), 3, "Address already in use");
  ScratchFolder scratch;
  std::ofstream(scratch / "file") << "somebody's";
  expect_refusal({"--points", kFewPoints, "--transport", "serial", "--device", scratch / "file"}, 3,
                 "is not a symbolic link");
  EXPECT_EQ(read_whole(scratch / "file"), "somebody's");
  expect_refusal({"--points", kFewPoints, "--transport", "serial", "--device", scratch / "none/cmm"}, 3,
                 "cannot make the link");
}

TEST(SimulatorCommand, TakesOverTheLinkOfAKilledMachine) {
  ScratchFolder scratch;
  const std::vector<std::string> options = {"--points", kFewPoints, "--transport",
                                            "serial",   "--device", scratch / "cmm"};
  SimulatedMachine killed(options);
  killed.process().power_off();
  EXPECT_TRUE(std::filesystem::is_symlink(scratch / "cmm"));
  SimulatedMachine next(options);
  EXPECT_NO_THROW(RawSerial(scratch / "cmm"));
}

TEST(SimulatorCommand, EndsCleanlyOnBothSignals) {
  for (const int number : {SIGINT, SIGTERM}) {
    SimulatedMachine machine(tcp({"--port", "0"}));
    machine.process().signal(number);
    EXPECT_EQ(machine.process().exit_code(2s), 0);
    EXPECT_EQ(machine.process().err(), "");
  }
}

TEST(SimulatorCommand, EndsWhenDoneAndStampsEveryRecord) {
  ScratchFolder scratch;
  const auto before = Clock::now().time_since_epoch() / 1ns;
  SimulatedMachine machine(tcp({"--port", "0", "--rate", "2000", "--stamp", scratch / "stamps", "--exit-when-done"}));
  {
    const RawModbus reader = RawModbus::tcp(machine.port());
    reader.command(1);
    ASSERT_TRUE(eventually([&] { return reader.newest() == 200; }, 5s));
    reader.acknowledge(199);
    EXPECT_TRUE(machine.process().running());
    reader.acknowledge(200);
  }
  EXPECT_EQ(machine.process().exit_code(2s), 0);
  std::ifstream stamps(scratch / "stamps");
  std::int64_t last = before;
  for (std::uint32_t sequence = 1; sequence <= 200; ++sequence) {
    std::uint32_t stamped = 0;
    char comma = 0;
    std::int64_t nanoseconds = 0;
    ASSERT_TRUE(stamps >> stamped >> comma >> nanoseconds);
    EXPECT_EQ(stamped, sequence);
    EXPECT_GE(nanoseconds, last);
    last = nanoseconds;
  }
  EXPECT_LE(last, Clock::now().time_since_epoch() / 1ns);
}

TEST(SimulatorCommand, ClaimsAnotherMapVersionOnRequest) {
  SimulatedMachine machine(tcp({"--port", "0", "--map-version", "2"}));
  EXPECT_EQ(RawModbus::tcp(machine.port()).inputs(0, 1).at(0), 2);
}

}  // namespace
}  // namespace bladefit::hil
