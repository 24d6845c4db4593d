// What a device that answers with exceptions does to a session, and what it does not.
#include <gtest/gtest.h>

#include <array>
#include <climits>

#include "drivers/make_source.hpp"
#include "tests/unit/drivers/modbus_tcp_machine.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

constexpr std::uint8_t kRead = 4, kCommand = 6, kAcknowledge = 16;
constexpr std::uint8_t kIllegalAddress = 2, kDeviceFailure = 4, kAcceptedSlowly = 5, kBusy = 6;
constexpr milliseconds kPollPeriod{10};

ModbusSettings settings_of(const TcpMachine& machine) {
  ModbusSettings settings = machine.settings();
  settings.poll_period = kPollPeriod;
  return settings;
}

void wait(ProbeSource& source, milliseconds time) {
  std::array<ProbePoint, 4> points;
  EXPECT_EQ(source.poll(points, time), 0U);
}

/// Refusals that came within `time` are no more than one a poll period.
void expect_no_flood(int refusals, milliseconds time) { EXPECT_LE(refusals, time / kPollPeriod + 2); }

class RefusedWrites : public ::testing::TestWithParam<std::uint8_t> {};

INSTANTIATE_TEST_SUITE_P(All, RefusedWrites,
                         ::testing::Values(kIllegalAddress, kDeviceFailure, kAcceptedSlowly, kBusy));

TEST_P(RefusedWrites, DoNotKeepFromReading) {
  TcpMachine machine;
  machine.registers.probe(3);
  const auto source = make_source(settings_of(machine));
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
  machine.registers.refuse(kAcknowledge, GetParam(), INT_MAX);
  source->acknowledge(3);
  machine.registers.probe(9);
  EXPECT_EQ(collect_checked(*source, 6), counted(4, 9));
  const int before = machine.registers.refusals();
  wait(*source, milliseconds(200));
  expect_no_flood(machine.registers.refusals() - before, milliseconds(200));
  EXPECT_NE(source->status().last_fault.find("refuses function 16 at register 0"), std::string::npos);
  machine.registers.refuse(kAcknowledge, GetParam(), 0);
  wait(*source, milliseconds(50));
  EXPECT_EQ(machine.registers.holding(1), 3);
}

TEST_P(RefusedWrites, DoNotKeepFromReadingAfterTheLinkCameBack) {
  TcpMachine machine;
  const auto source = make_source(settings_of(machine));
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.registers.probe(3);
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
  source->acknowledge(3);
  wait(*source, milliseconds(30));
  machine.registers.refuse(kAcknowledge, GetParam(), INT_MAX);
  machine.mischief = Mischief::hang_up;
  wait(*source, milliseconds(200));
  EXPECT_EQ(source->status().reconnects, 1U);
  expect_no_flood(machine.registers.refusals(), milliseconds(200));
  machine.registers.probe(9);
  EXPECT_EQ(collect_checked(*source, 6), counted(4, 9));
}

class RefusedReads : public ::testing::TestWithParam<std::uint16_t> {};

INSTANTIATE_TEST_SUITE_P(FromRegister, RefusedReads, ::testing::Values(0, 100));

TEST_P(RefusedReads, AreTriedAgainOnceAPollPeriod) {
  TcpMachine machine;
  const auto source = make_source(settings_of(machine));
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.registers.refuse(kRead, kBusy, INT_MAX, GetParam());
  machine.registers.probe(3);
  wait(*source, milliseconds(200));
  expect_no_flood(machine.registers.refusals(), milliseconds(200));
  machine.registers.refuse(kRead, kBusy, 0);
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
}

struct BusyCase {
  std::uint8_t function, exception;
};

class BusyAtOpening : public ::testing::TestWithParam<BusyCase> {};

INSTANTIATE_TEST_SUITE_P(All, BusyAtOpening,
                         ::testing::Values(BusyCase{kRead, kBusy}, BusyCase{kAcknowledge, kAcceptedSlowly},
                                           BusyCase{kAcknowledge, kBusy}, BusyCase{kCommand, kBusy}));

TEST_P(BusyAtOpening, IsWaitedFor) {
  TcpMachine machine;
  machine.registers.refuse(GetParam().function, GetParam().exception, 7);
  const auto source = make_source(settings_of(machine));
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(machine.registers.refusals(), 7);
  EXPECT_EQ(machine.registers.holding(2), 1);
  machine.registers.probe(3);
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
}

TEST_P(BusyAtOpening, IsNotWaitedForEver) {
  TcpMachine machine;
  machine.registers.refuse(GetParam().function, GetParam().exception, INT_MAX);
  ModbusSettings settings = settings_of(machine);
  settings.connect_timeout = milliseconds(100);
  settings.reply_timeout = milliseconds(20);
  const std::string message = make_source(settings)->open(0, 0).message;
  EXPECT_NE(message.find("the device refuses function"), std::string::npos) << message;
  EXPECT_NE(message.find("; end what keeps it busy"), std::string::npos) << message;
}

TEST(RefusedAtOpening, ForGoodIsAnError) {
  TcpMachine machine;
  machine.registers.refuse(kAcknowledge, kDeviceFailure, 1);
  const std::string message = make_source(settings_of(machine))->open(0, 0).message;
  EXPECT_NE(message.find("; correct the addresses"), std::string::npos) << message;
}

}  // namespace
}  // namespace bladefit
