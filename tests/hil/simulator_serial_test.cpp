// The simulated machine on a serial line, seen by a host that shares nothing with the drivers.
#include <gtest/gtest.h>

#include <map>

#include "tests/hil/raw_readers.hpp"

namespace bladefit::hil {
namespace {

/// A machine on a line of its own.
struct Line {
  explicit Line(const std::vector<std::string>& more)
      : machine(std::vector<std::string>{"--points", kFewPoints, "--transport", "serial", "--device", scratch / "cmm"} +
                more) {}
  ScratchFolder scratch;
  SimulatedMachine machine;
};

std::uint32_t sequence_of(const std::vector<std::string>& fields) {
  return static_cast<std::uint32_t>(std::stoul(fields.at(1)));
}

/// Takes every point as a patient host does: asks again from the first that is missing, opens the line again when it
/// was hung up. Returns the lines by their sequence; fewer than 200 when patience was over.
std::map<std::uint32_t, std::vector<std::string>> take_all(const std::string& device) {
  std::map<std::uint32_t, std::vector<std::string>> taken;
  const Clock::time_point until = Clock::now() + 20s;
  while (Clock::now() < until) {
    RawSerial host(device);
    host.send("START," + std::to_string(taken.size() + 1));
    while (const std::optional<std::string> line = host.line(1s)) {
      const std::vector<std::string> fields = RawSerial::fields(*line);
      const std::string next = std::to_string(taken.size() + 1);
      if (fields.empty() || (fields[0] == "PT" && sequence_of(fields) > taken.size() + 1)) {
        host.send("NAK," + next);
      } else if (fields[0] == "PT" && sequence_of(fields) == taken.size() + 1) {
        taken[sequence_of(fields)] = fields;
        host.send("ACK," + next);
      } else if (fields[0] == "END") {
        if (taken.size() == sequence_of(fields)) return taken;
        host.send("NAK," + next);
      }
    }
  }
  return taken;
}

void expect_all_points(const std::map<std::uint32_t, std::vector<std::string>>& taken) {
  const std::vector<RawPoint> points = read_raw_points(kFewPoints);
  ASSERT_EQ(taken.size(), points.size());
  for (const auto& [sequence, fields] : taken) {
    ASSERT_EQ(fields.size(), 9U);
    const RawPoint& point = points[sequence - 1];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(std::stod(fields[2 + axis]), point.position[axis]);
      EXPECT_EQ(std::stod(fields[5 + axis]), point.direction[axis]);
    }
    EXPECT_EQ(std::stoi(fields[8]), point.path);
  }
}

TEST(SimulatorSerial, StartIsAnsweredThenPointsThenEnd) {
  Line line({"--rate", "0", "--run-id", "77"});
  RawSerial host(line.machine.address());
  EXPECT_EQ(host.line(100ms), std::nullopt);
  host.send("START,199");
  EXPECT_EQ(host.line(), framed("RUN,77").substr(0, 12));
  EXPECT_EQ(RawSerial::fields(host.line().value_or("")).at(1), "199");
  EXPECT_EQ(RawSerial::fields(host.line().value_or("")).at(1), "200");
  EXPECT_EQ(RawSerial::fields(host.line().value_or("")), (std::vector<std::string>{"END", "200"}));
  EXPECT_EQ(RawSerial::fields(host.line().value_or("")), (std::vector<std::string>{"END", "200"}));
  host.send("STOP");
  EXPECT_EQ(host.line(1500ms), std::nullopt);
}

TEST(SimulatorSerial, EveryPointIsExact) {
  Line line({"--rate", "0"});
  expect_all_points(take_all(line.machine.address()));
}

TEST(SimulatorSerial, WaitsForTheAcknowledgeAndResendsWhatIsMissing) {
  Line line({"--rate", "0", "--capacity", "10"});
  RawSerial host(line.machine.address());
  host.send("START,1");
  int lines = 0;
  while (host.line(200ms)) ++lines;
  EXPECT_EQ(lines, 11);
  host.send("NAK,9");
  EXPECT_EQ(sequence_of(RawSerial::fields(host.line().value_or(""))), 9U);
  EXPECT_EQ(sequence_of(RawSerial::fields(host.line().value_or(""))), 10U);
  EXPECT_EQ(host.line(100ms), std::nullopt);
  host.send("ACK,4");
  EXPECT_EQ(sequence_of(RawSerial::fields(host.line().value_or(""))), 11U);
}

TEST(SimulatorSerial, PassesOverNoiseAndDamagedCommands) {
  Line line({"--rate", "0"});
  RawSerial host(line.machine.address());
  host.send_raw(std::string("\0\xFF noise without end $START,1*0000\r\n$START,1*\r\n*\r\n$\n", 53));
  host.send_raw(std::string(10000, 'x'));
  host.send("START,0");
  host.send("START,500");
  host.send("WHAT,1");
  EXPECT_EQ(host.line(300ms), std::nullopt);
  host.send("START,1");
  EXPECT_EQ(RawSerial::fields(host.line().value_or("")).at(0), "RUN");
}

TEST(SimulatorSerial, EveryFaultAloneAndAllTogetherCanBeMended) {
  for (const char* faults : {"drop=0.1", "duplicate=0.1", "corrupt=0.1", "delay=0.1:20ms", "disconnect=0.03",
                             "drop=0.05,duplicate=0.05,corrupt=0.05,delay=0.05:20ms,disconnect=0.02,seed=3"}) {
    SCOPED_TRACE(faults);
    Line line({"--rate", "0", "--faults", faults, "--verbose"});
    expect_all_points(take_all(line.machine.address()));
    EXPECT_NE(line.machine.process().err().find("simulate: fault:"), std::string::npos);
  }
}

TEST(SimulatorSerial, TheSameSeedMakesTheSameFaults) {
  const auto faults_of = [](const std::string& seed) {
    Line line({"--rate", "0", "--faults", "drop=0.1,duplicate=0.1,corrupt=0.1", "--seed", seed, "--verbose"});
    RawSerial host(line.machine.address());
    host.send("START,1");
    (void)eventually([&] { return host.line(100ms) == framed("END,200").substr(0, 13); }, 5s);
    return line.machine.process().err();
  };
  const std::string first = faults_of("5");
  EXPECT_NE(first.find("fault:"), std::string::npos);
  EXPECT_EQ(faults_of("5"), first);
  EXPECT_NE(faults_of("6"), first);
}

}  // namespace
}  // namespace bladefit::hil
