// The simulated machine over Modbus, seen by a reader that shares nothing with the drivers.
#include <gtest/gtest.h>

#include "tests/hil/raw_readers.hpp"

namespace bladefit::hil {
namespace {

std::vector<std::string> tcp_options(const std::vector<std::string>& more, const std::string& points = kFewPoints,
                                     int port = 0) {
  return std::vector<std::string>{"--points", points, "--transport", "modbus-tcp", "--port", std::to_string(port)} +
         more;
}

void expect_point(const RawRecord& record, const RawPoint& point) {
  EXPECT_TRUE(record.intact);
  EXPECT_EQ(record.point.position, point.position);
  EXPECT_EQ(record.point.path, point.path);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(record.point.direction[axis], point.direction[axis], 0.5 / 32767 + 1e-12);
  }
}

TEST(SimulatorModbus, ChecksumIsThatOfModbus) {
  EXPECT_EQ(simulate::check_sum("123456789", cmm_map_v1::kCrcInitial, cmm_map_v1::kCrcPolynomial), 0x4B37);
}

TEST(SimulatorModbus, HeaderIsThatOfMapVersion1) {
  SimulatedMachine machine(tcp_options({"--run-id", "70000", "--capacity", "100"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  const std::vector<std::uint16_t> expected = {1, 1, 0, 0, 100, 20, 1, 70000 - 65536, 0x40C8, 0x1CD6, 0xC8B4, 0x3958};
  EXPECT_EQ(reader.inputs(0, 12), expected);
}

TEST(SimulatorModbus, EveryPointComesOnceAskedForInOrderAndExact) {
  SimulatedMachine machine(tcp_options({"--rate", "0", "--capacity", "32"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  EXPECT_EQ(reader.newest(), 0U);
  ASSERT_TRUE(reader.command(1));
  const std::vector<RawPoint> points = read_raw_points(kFewPoints);
  ASSERT_EQ(points.size(), 200U);
  for (std::uint32_t sequence = 1; sequence <= points.size(); ++sequence) {
    ASSERT_TRUE(eventually([&] { return reader.newest() >= sequence; }, 2s)) << sequence;
    EXPECT_LE(reader.newest(), sequence - 1 + 32);
    const RawRecord record = reader.record(sequence, 32);
    EXPECT_EQ(record.sequence, sequence);
    expect_point(record, points[sequence - 1]);
    ASSERT_TRUE(reader.acknowledge(sequence));
  }
  EXPECT_EQ(reader.status(), 1U | 16U);
}

TEST(SimulatorModbus, InchesBecomeMillimetres) {
  ScratchFolder scratch;
  std::ofstream(scratch / "points.csv") << "x,y,z\n1,2,-3\n";
  SimulatedMachine machine(tcp_options({"--rate", "0", "--units", "in"}, scratch / "points.csv"));
  const RawModbus reader = RawModbus::tcp(machine.port());
  reader.command(1);
  ASSERT_TRUE(eventually([&] { return reader.newest() == 1; }, 2s));
  EXPECT_EQ(reader.record(1).point.position, (std::array<double, 3>{25.4, 50.8, -3 * 25.4}));
}

TEST(SimulatorModbus, PointsComeAtTheRateAndStopOnCommand) {
  SimulatedMachine machine(tcp_options({"--rate", "100"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  reader.command(1);
  std::this_thread::sleep_for(500ms);
  const std::uint32_t after_half_a_second = reader.newest();
  EXPECT_GE(after_half_a_second, 40U);
  EXPECT_LE(after_half_a_second, 90U);
  reader.command(2);
  const std::uint32_t stopped = reader.newest();
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(reader.newest(), stopped);
  EXPECT_EQ(reader.status(), 1U);
}

TEST(SimulatorModbus, WaitsForTheAcknowledgeUnlessOverflowIsOn) {
  SimulatedMachine waiting(tcp_options({"--rate", "0", "--capacity", "10"}));
  const RawModbus reader = RawModbus::tcp(waiting.port());
  reader.command(1);
  ASSERT_TRUE(eventually([&] { return reader.newest() == 10; }, 2s));
  EXPECT_EQ(reader.status(), 2U);

  SimulatedMachine losing(tcp_options({"--rate", "0", "--capacity", "10", "--faults", "overflow"}));
  const RawModbus late_reader = RawModbus::tcp(losing.port());
  late_reader.command(1);
  ASSERT_TRUE(eventually([&] { return late_reader.newest() == 200; }, 2s));
  EXPECT_EQ(late_reader.status(), 1U | 8U | 16U);
  EXPECT_EQ(late_reader.record(191, 10).sequence, 191U);
}

TEST(SimulatorModbus, RestartsFromTheAcknowledgedRecordEvenAfterAPowerCut) {
  std::optional<SimulatedMachine> machine(std::in_place, tcp_options({"--rate", "0", "--capacity", "10"}));
  const int port = machine->port();
  {
    const RawModbus reader = RawModbus::tcp(port);
    reader.command(1);
    reader.acknowledge(7);
    ASSERT_TRUE(eventually([&] { return reader.newest() == 17; }, 2s));
    reader.acknowledge(3);
    reader.command(3);
    ASSERT_TRUE(eventually([&] { return reader.newest() == 13; }, 2s));
    EXPECT_EQ(reader.record(4, 10).sequence, 4U);
  }
  machine->process().power_off();
  machine.reset();
  machine.emplace(tcp_options({"--rate", "0", "--capacity", "10"}, kFewPoints, port));
  const RawModbus reader = RawModbus::tcp(port);
  reader.acknowledge(20);
  reader.command(3);
  ASSERT_TRUE(eventually([&] { return reader.newest() == 30; }, 2s));
  EXPECT_EQ(reader.record(21, 10).sequence, 21U);
}

TEST(SimulatorModbus, ServesSeveralReadersWhileOneIsStuck) {
  SimulatedMachine machine(tcp_options({"--rate", "0"}));
  const RawModbus stuck = RawModbus::tcp(machine.port());
  const std::array<char, 5> half_a_request = {0, 1, 0, 0, 0};
  ASSERT_EQ(write(modbus_get_socket(stuck.context()), half_a_request.data(), half_a_request.size()), 5);
  const RawModbus first = RawModbus::tcp(machine.port());
  const RawModbus second = RawModbus::tcp(machine.port());
  first.command(1);
  ASSERT_TRUE(eventually([&] { return second.newest() == 200; }, 2s));
  EXPECT_EQ(first.newest(), 200U);
}

TEST(SimulatorModbus, FaultDropMeansNoAnswer) {
  SimulatedMachine machine(tcp_options({"--faults", "drop=1", "--verbose"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  EXPECT_TRUE(reader.inputs(0, 12).empty());
  EXPECT_NE(machine.process().err().find("no answer to function 4 at 0"), std::string::npos);
}

TEST(SimulatorModbus, FaultCorruptDamagesOneReplyOnly) {
  SimulatedMachine machine(tcp_options({"--rate", "0", "--faults", "corrupt=0.5"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  reader.command(1);
  ASSERT_TRUE(eventually([&] { return reader.newest() == 200; }, 2s));
  int damaged = 0;
  for (int attempt = 0; attempt < 100; ++attempt) damaged += reader.record(5).intact ? 0 : 1;
  EXPECT_GT(damaged, 25);
  EXPECT_LT(damaged, 75);
}

TEST(SimulatorModbus, FaultDelayAnswersLate) {
  SimulatedMachine machine(tcp_options({"--faults", "delay=1:300ms"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  const Clock::time_point before = Clock::now();
  EXPECT_EQ(reader.inputs(0, 12).size(), 12U);
  EXPECT_GE(Clock::now() - before, 300ms);
}

TEST(SimulatorModbus, FaultDuplicateShowsAnOlderSequenceOrAnswersTwice) {
  SimulatedMachine machine(tcp_options({"--rate", "0", "--faults", "duplicate=1"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  modbus_set_response_timeout(reader.context(), 0, 200000);
  reader.command(1);
  std::this_thread::sleep_for(50ms);
  modbus_flush(reader.context());
  EXPECT_EQ(reader.newest(), 199U);
  EXPECT_TRUE(reader.record(1).intact);
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> second{};
  EXPECT_EQ(modbus_receive_confirmation(reader.context(), second.data()), 9 + 40);
}

TEST(SimulatorModbus, FaultDisconnectClosesTheLink) {
  SimulatedMachine machine(tcp_options({"--faults", "disconnect=1"}));
  const RawModbus reader = RawModbus::tcp(machine.port());
  EXPECT_TRUE(reader.inputs(0, 12).empty());
  EXPECT_EQ(errno, ECONNRESET);
  EXPECT_NO_THROW(RawModbus::tcp(machine.port()));
}

TEST(SimulatorModbus, RtuServesTheSameMapAndALinkThatOutlivesAHangUp) {
  ScratchFolder scratch;
  const std::string device = scratch / "cmm";
  SimulatedMachine machine({"--points", kFewPoints, "--transport", "modbus-rtu", "--device", device, "--rate", "0"});
  EXPECT_EQ(machine.address(), device);
  const std::vector<RawPoint> points = read_raw_points(kFewPoints);
  for (int visit = 0; visit < 2; ++visit) {
    const RawModbus reader = RawModbus::rtu(device);
    ASSERT_TRUE(reader.command(1));
    ASSERT_TRUE(eventually([&] { return reader.newest() == 200; }, 2s));
    expect_point(reader.record(123), points[122]);
    modbus_close(reader.context());
    std::this_thread::sleep_for(50ms);
  }
  machine.process().signal(SIGTERM);
  EXPECT_EQ(machine.process().exit_code(), 0);
  EXPECT_FALSE(std::filesystem::is_symlink(device));
}

TEST(SimulatorModbus, RtuPassesOverNoiseAndOtherUnits) {
  ScratchFolder scratch;
  SimulatedMachine machine({"--points", kFewPoints, "--transport", "modbus-rtu", "--device", scratch / "cmm"});
  const RawModbus reader = RawModbus::rtu(scratch / "cmm");
  modbus_set_slave(reader.context(), 7);
  EXPECT_TRUE(reader.inputs(0, 12).empty());
  modbus_set_slave(reader.context(), 1);
  ASSERT_EQ(write(modbus_get_socket(reader.context()), "\x01\x55noise", 7), 7);
  std::this_thread::sleep_for(300ms);
  EXPECT_TRUE(eventually([&] { return reader.inputs(0, 12).size() == 12; }, 3s));
}

}  // namespace
}  // namespace bladefit::hil
