#include <gtest/gtest.h>

#include <array>

#include "drivers/make_source.hpp"
#include "tests/unit/drivers/modbus_tcp_machine.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

TEST(ModbusTcp, StartsDeliversAcknowledgesAndStops) {
  TcpMachine machine;
  machine.registers.probe(3);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(machine.registers.holding(2), 1);
  EXPECT_EQ(source->status().run_id, 5U);
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
  machine.registers.probe(15);
  EXPECT_EQ(collect_checked(*source, 12), counted(4, 15));
  source->acknowledge(15);
  std::array<ProbePoint, 4> points;
  EXPECT_EQ(source->poll(points, milliseconds(10)), 0U);
  EXPECT_EQ(machine.registers.holding(1), 15);
  machine.registers.set(1, 16);
  EXPECT_EQ(source->poll(points, milliseconds(30)), 0U);
  EXPECT_TRUE(source->status().finished);
  source->close();
  EXPECT_EQ(machine.registers.holding(2), 2);
}

TEST(ModbusTcp, GoesOnBehindWhatIsStored) {
  TcpMachine machine;
  machine.registers.probe(9);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(7, 5).message, "");
  EXPECT_EQ(machine.registers.holding(1), 7);
  EXPECT_EQ(machine.registers.holding(2), 0) << "a device that is probing is left alone";
  EXPECT_EQ(collect_checked(*source, 2), counted(8, 9));
}

TEST(ModbusTcp, GoesOnAfterAsManyBadRecordsAsTheRingHolds) {
  TcpMachine machine;
  machine.registers.probe(kCapacity);
  for (std::size_t slot = 0; slot < kCapacity; ++slot) machine.registers.set(100 + slot * 20 + 19, 1);
  ModbusSettings settings = machine.settings();
  settings.record_tries = 3;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  for (int turn = 0; turn < 200 && source->status().last < kCapacity; ++turn)
    EXPECT_EQ(collect(*source, 1, milliseconds(10)), Sequences{});
  EXPECT_EQ(source->status().last, kCapacity) << source->status().last_fault;
  EXPECT_EQ(source->status().losses, kCapacity);
  source->acknowledge(source->status().last);
  machine.registers.probe(kCapacity + 4);
  EXPECT_EQ(collect_checked(*source, 4), counted(kCapacity + 1, kCapacity + 4));
  EXPECT_EQ(machine.registers.holding(1), kCapacity);
}

TEST(ModbusTcp, ADeviceThatNumbersAgainIsToldOfNoRecordBeyondItsOwn) {
  TcpMachine machine;
  machine.registers.probe(8);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 8), counted(1, 8));
  machine.registers.set(3, 3);
  EXPECT_EQ(collect(*source, 1, milliseconds(100)), Sequences{});
  EXPECT_NE(source->status().stopped.find("newest record is 3 although record 8 was read before"), std::string::npos)
      << source->status().last_fault;
  source->acknowledge(8);
  EXPECT_EQ(collect(*source, 1, milliseconds(50)), Sequences{});
  source->close();
  EXPECT_EQ(machine.registers.holding(1), 0);

  const auto resumed = make_source(machine.settings());
  const Failure refused = resumed->open(8, 5);
  EXPECT_EQ(refused.kind, Failure::Kind::device);
  EXPECT_NE(refused.message.find("start a session in another folder"), std::string::npos) << refused.message;
  EXPECT_EQ(machine.registers.holding(1), 0);
}

TEST(ModbusTcp, SurvivesEveryMischief) {
  TcpMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  std::uint32_t newest = 0;
  for (const Mischief mischief :
       {Mischief::silent, Mischief::late, Mischief::foreign_first, Mischief::hang_up, Mischief::wrong_length}) {
    for (int round = 0; round < 2; ++round) {
      machine.mischief = mischief;
      machine.registers.probe(newest + 2);
      EXPECT_EQ(collect_checked(*source, 2), counted(newest + 1, newest + 2)) << static_cast<int>(mischief);
      newest += 2;
      source->acknowledge(newest);
    }
  }
  EXPECT_EQ(source->status().reconnects, 4U) << source->status().last_fault;
  EXPECT_EQ(source->status().losses, 0U);
}

TEST(ModbusTcp, GivesUpADeadConnectionAndTellsSo) {
  TcpMachine machine;
  ModbusSettings settings = machine.settings();
  settings.reply_timeout = milliseconds(20);
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.dumb = true;
  EXPECT_EQ(collect_checked(*source, 1).size(), 0U);
  EXPECT_EQ(source->status().link, LinkState::lost);
  expect_answers_again(machine, *source);
  EXPECT_GT(source->status().reconnects, 0U);
}

TEST(ModbusTcp, PollReturnsInTimeWhateverTheDeviceDoes) {
  TcpMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.dumb = true;
  std::array<ProbePoint, 4> points;
  for (int call = 0; call < 20; ++call) {
    const auto before = std::chrono::steady_clock::now();
    static_cast<void>(source->poll(points, milliseconds(10)));
    EXPECT_LT(std::chrono::steady_clock::now() - before, milliseconds(60));
  }
}

TEST(ModbusTcp, ReportsLostRecords) {
  TcpMachine machine;
  machine.registers.probe(20);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 16), counted(5, 20));
  EXPECT_GT(source->status().losses, 0U);
}

/// Two runs; 0 is one like any other.
struct RunChange {
  std::uint16_t from, to;
};

class ModbusTcpRuns : public ::testing::TestWithParam<RunChange> {};

INSTANTIATE_TEST_SUITE_P(All, ModbusTcpRuns, ::testing::Values(RunChange{4, 5}, RunChange{5, 0}, RunChange{0, 7}));

/// Nothing of the run that the device is in is stored: it is not told so, and its program is not stopped.
TEST_P(ModbusTcpRuns, ADeviceInAnotherRunIsLeftAlone) {
  TcpMachine machine;
  machine.registers.set(7, GetParam().to);
  machine.registers.probe(9);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(7, GetParam().from).message, "");
  EXPECT_EQ(source->status().run_id, GetParam().to);
  source->acknowledge(7);
  source->close();
  EXPECT_EQ(machine.registers.holding(1), 0);
  EXPECT_EQ(machine.registers.holding(2), 0);
}

TEST_P(ModbusTcpRuns, AnotherRunStopsTheReading) {
  TcpMachine machine;
  machine.registers.set(7, GetParam().from);
  machine.registers.probe(2);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 2), counted(1, 2));
  machine.registers.set(7, GetParam().to);
  std::array<ProbePoint, 4> points;
  EXPECT_EQ(source->poll(points, milliseconds(50)), 0U);
  EXPECT_EQ(source->status().run_id, GetParam().to);
  EXPECT_NE(source->status().last_fault.find("another run"), std::string::npos);
  source->acknowledge(2);
  source->close();
  EXPECT_EQ(machine.registers.holding(1), 0) << "none of the other run's records is stored";
  EXPECT_EQ(machine.registers.holding(2), 1);
}

TEST_P(ModbusTcpRuns, TheRunThatTheStartHasBegunIsAcknowledged) {
  TcpMachine machine;
  machine.registers.set(7, GetParam().from);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.registers.set(7, GetParam().to);
  std::array<ProbePoint, 4> points;
  EXPECT_EQ(source->poll(points, milliseconds(50)), 0U);
  machine.registers.probe(2);
  EXPECT_EQ(collect_checked(*source, 2), counted(1, 2));
  EXPECT_EQ(source->poll(points, milliseconds(50)), 0U);
  source->acknowledge(2);
  EXPECT_EQ(source->poll(points, milliseconds(50)), 0U);
  EXPECT_EQ(machine.registers.holding(1), 2);
}

TEST(ModbusTcpErrors, NameTheDeviceAndTheFix) {
  TcpMachine machine;
  const auto opened = [&machine](const ModbusSettings& settings) { return make_source(settings)->open(0, 0).message; };
  const std::string name = "modbus-tcp://127.0.0.1:" + std::to_string(machine.port) + ": ";
  machine.registers.set(0, 2);
  EXPECT_EQ(opened(machine.settings()),
            name + "it has register map version 2, not 1; give a device file that describes its map");
  machine.registers.set(0, 1);
  ModbusSettings swapped = machine.settings();
  swapped.map.test_constant.address = 8;
  for (const auto& [address, word] : {std::pair{8, 0x3958}, {9, 0xC8B4}, {10, 0x1CD6}, {11, 0x40C8}}) {
    machine.registers.set(static_cast<std::size_t>(address), static_cast<std::uint16_t>(word));
  }
  EXPECT_NE(opened(swapped).find("set word_order = \"low_first\""), std::string::npos);
  ModbusSettings elsewhere = machine.settings();
  elsewhere.map.newest.address = 999;
  elsewhere.map.version.present = elsewhere.map.status.present = elsewhere.map.capacity.present = false;
  elsewhere.map.reported_record_size.present = elsewhere.map.run_id.present = false;
  elsewhere.map.test_constant.present = false;
  elsewhere.map.ring_capacity = 16;
  EXPECT_NE(opened(elsewhere).find("the device refuses function 4 at register 999: Illegal data address"),
            std::string::npos);
  machine.dumb = true;
  ModbusSettings mute = machine.settings();
  mute.reply_timeout = milliseconds(20);
  EXPECT_NE(opened(mute).find("unit 1 does not answer"), std::string::npos);
  ModbusSettings unknown = machine.settings();
  unknown.tcp.host = "no.such.host.invalid";
  EXPECT_NE(opened(unknown).find("the host is not known"), std::string::npos);
}

TEST(ModbusTcpErrors, NameARefusedConnection) {
  ModbusSettings settings;
  {
    const TcpMachine machine;
    settings = machine.settings();
  }
  EXPECT_NE(make_source(settings)->open(0, 0).message.find("connection refused; switch on"), std::string::npos);
}

}  // namespace
}  // namespace bladefit
