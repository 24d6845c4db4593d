// Devices as they are: other units, functions, orders and registers than the map has.
#include <gtest/gtest.h>

#include <string>

#include "drivers/make_source.hpp"
#include "drivers/modbus/cmm_header.hpp"
#include "tests/unit/drivers/modbus_tcp_machine.hpp"

namespace bladefit {
namespace {

bool contains(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

int remarks_with(const ProbeSource& source, const std::string& words) {
  return static_cast<int>(std::ranges::count_if(source.status().remarks,
                                                [&](const std::string& remark) { return contains(remark, words); }));
}

TEST(ModbusHabits, UnitZeroIsAskedOverTcp) {
  TcpMachine machine;
  machine.only_unit = 0;
  machine.registers.probe(3);
  ModbusSettings settings = machine.settings();
  settings.unit = 0;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
}

TEST(ModbusHabits, AnotherUnitThatAnswersIsNamed) {
  TcpMachine machine;
  machine.reply_unit = 0;
  ModbusSettings settings = machine.settings();
  settings.reply_timeout = std::chrono::milliseconds(30);
  EXPECT_TRUE(contains(make_source(settings)->open(0, 0).message,
                       "unit 0 answers in place of unit 1; set unit = 0 in the device file"));
}

TEST(ModbusHabits, AnotherUnitThatAnswersInMidSessionIsNamed) {
  TcpMachine machine;
  ModbusSettings settings = machine.settings();
  settings.reply_timeout = std::chrono::milliseconds(30);
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.reply_unit = 9;
  static_cast<void>(collect(*source, 1, std::chrono::milliseconds(100)));
  EXPECT_TRUE(contains(source->status().last_fault, "unit 9 answers in place of unit 1"))
      << source->status().last_fault;
}

TEST(ModbusHabits, HoldingRegistersAreReadWhereFunctionFourIsUnknown) {
  TcpMachine machine;
  machine.registers.forget_function(4);
  machine.registers.probe(3);
  ModbusSettings settings = machine.settings();
  settings.map.acknowledge.address = 900;
  settings.map.acknowledge.present = false;
  settings.map.command.present = false;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
  EXPECT_EQ(remarks_with(*source, "does not know function 4: its holding registers are read"), 1);
}

TEST(ModbusHabits, NothingIsWrittenToRegistersThatAreRead) {
  TcpMachine machine;
  machine.registers.forget_function(4);
  machine.registers.probe(3);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
  source->acknowledge(3);
  machine.registers.probe(4);
  EXPECT_EQ(collect_checked(*source, 1), counted(4, 4));
  source->close();
  for (const std::size_t address : {0U, 1U, 2U}) EXPECT_EQ(machine.registers.holding(address), 0) << address;
  EXPECT_EQ(remarks_with(*source, "acknowledge is not written: register 0 is one of those read"), 1);
  EXPECT_EQ(remarks_with(*source, "command is not written: register 2 is one of those read"), 1);
}

TEST(ModbusHabits, WithoutAnyReadingFunctionTheDeviceIsRefused) {
  TcpMachine machine;
  machine.registers.forget_function(3);
  machine.registers.forget_function(4);
  EXPECT_TRUE(contains(make_source(machine.settings())->open(0, 0).message, "refuses function 3 at register 0"));
}

TEST(ModbusHabits, ADeviceThatTakesNoWritesIsReadAndToldOfOnce) {
  TcpMachine machine;
  machine.registers.forget_function(6);
  machine.registers.forget_function(16);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  for (std::uint32_t newest = 1; newest <= 3; ++newest) {
    machine.registers.probe(newest);
    EXPECT_EQ(collect_checked(*source, 1), counted(newest, newest));
    source->acknowledge(newest);
  }
  EXPECT_EQ(remarks_with(*source, "refuses function 16 at register 0: Illegal function; nothing is written there"), 1);
  EXPECT_EQ(remarks_with(*source, "refuses function 6 at register 2: Illegal function; nothing is written there"), 1);
}

TEST(ModbusHabits, ADeviceWithoutTheRegistersToWriteToIsReadAndToldOfOnce) {
  TcpMachine machine;
  machine.registers.refuse(16, 2, 1000);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  for (std::uint32_t newest = 1; newest <= 3; ++newest) {
    machine.registers.probe(newest);
    EXPECT_EQ(collect_checked(*source, 1), counted(newest, newest));
    source->acknowledge(newest);
  }
  EXPECT_EQ(remarks_with(*source, "refuses function 16 at register 0: Illegal data address"), 1);
  EXPECT_EQ(machine.registers.refusals(), 1) << "it is not asked again";
  EXPECT_EQ(machine.registers.holding(2), 1) << "the command is given all the same";
}

TEST(ModbusHabits, MissingRegistersToWriteToAreToldOfOnce) {
  TcpMachine machine;
  machine.registers.probe(2);
  ModbusSettings settings = machine.settings();
  settings.map.acknowledge.present = settings.map.command.present = false;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 2), counted(1, 2));
  EXPECT_EQ(remarks_with(*source, "has no acknowledge register"), 1);
  EXPECT_EQ(remarks_with(*source, "has no command register"), 1);
  EXPECT_EQ(source->status().remarks.size(), 2U);
}

struct SwapCase {
  bool everywhere;
  ByteOrder order;
  const char* setting;
};

class ModbusByteOrders : public ::testing::TestWithParam<SwapCase> {};

INSTANTIATE_TEST_SUITE_P(All, ModbusByteOrders,
                         ::testing::Values(SwapCase{true, ByteOrder::low_first, "set byte_order = \"low_first\""},
                                           SwapCase{false, ByteOrder::low_first_in_long,
                                                    "set byte_order = \"low_first_in_long\""}));

TEST_P(ModbusByteOrders, AreToldByTheTestConstantAndReadWhereSet) {
  TcpMachine machine;
  machine.registers.probe(3);
  machine.registers.swap_bytes(GetParam().everywhere);
  ModbusSettings settings = machine.settings();
  const std::string refusal = make_source(settings)->open(0, 0).message;
  EXPECT_TRUE(contains(refusal, GetParam().setting)) << refusal;
  settings.map.byte_order = GetParam().order;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
}

TEST(ModbusHabits, WordsAndBytesMayBothBeSwapped) {
  std::vector<std::uint16_t> words = {1, 2, 0, 5, 16, 20, 0, 7, 0, 0, 0, 0};
  put_double(std::span(words).subspan(8), 12345.678);
  std::reverse(words.begin() + 8, words.end());
  for (std::uint16_t& word : words) word = static_cast<std::uint16_t>((word << 8U) | (word >> 8U));
  const std::string message = check_header(decode_header(words, CmmMap{}), CmmMap{}).message;
  EXPECT_TRUE(contains(message, "set word_order = \"low_first\" and byte_order = \"low_first\"")) << message;
}

TEST(ModbusHabits, AStatusMayBeANumber) {
  TcpMachine machine;
  machine.registers.set(1, 20);
  machine.registers.probe(2);
  ModbusSettings settings = machine.settings();
  settings.map.status_values = {{0, 10},
                                {settings.map.probing_mask, 20},
                                {settings.map.fault_mask, 90},
                                {settings.map.fault_mask, 91},
                                {settings.map.finished_mask, 30}};
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 2), counted(1, 2));
  machine.registers.set(1, 91);
  static_cast<void>(collect(*source, 1, std::chrono::milliseconds(30)));
  EXPECT_TRUE(source->status().device_fault);
  machine.registers.set(1, 31);
  static_cast<void>(collect(*source, 1, std::chrono::milliseconds(30)));
  EXPECT_FALSE(source->status().device_fault);
  EXPECT_FALSE(source->status().finished) << "31 has the bits of nothing";
  EXPECT_EQ(remarks_with(*source, "gives no meaning to the status"), 1);
  machine.registers.set(1, 30);
  static_cast<void>(collect(*source, 1, std::chrono::milliseconds(50)));
  EXPECT_TRUE(source->status().finished);
}

}  // namespace
}  // namespace bladefit
