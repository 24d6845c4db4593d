#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "drivers/modbus/cmm_header.hpp"
#include "drivers/modbus/cmm_record.hpp"
#include "drivers/modbus/modbus_frame.hpp"
#include "drivers/modbus/number_codec.hpp"
#include "drivers/source/crc16.hpp"

namespace bladefit {
namespace {

static_assert(crc16("123456789") == 0x4B37);

using Words = std::vector<std::uint16_t>;

TEST(Crc16, TakesTheHighByteOfARegisterFirst) {
  const std::array<std::uint16_t, 4> words = {0x3132, 0x3334, 0x3536, 0x3738};
  EXPECT_EQ(crc16(std::span<const std::uint16_t>(words)), crc16("12345678"));
  EXPECT_EQ(cmm_map_v1::kCrcPolynomial, serial_protocol_v1::kCrcPolynomial);
}

struct Number {
  NumberType type;
  RegisterOrder order;
  Words words;
  double value;
};

class NumberCodec : public ::testing::TestWithParam<Number> {};

TEST_P(NumberCodec, DecodesEveryTypeInBothOrders) {
  EXPECT_EQ(decode_number(GetParam().words, GetParam().type, GetParam().order), GetParam().value);
}

INSTANTIATE_TEST_SUITE_P(
    All, NumberCodec,
    ::testing::Values(
        Number{NumberType::uint16, WordOrder::high_first, {0xFFFE}, 65534},
        Number{NumberType::int16, WordOrder::low_first, {0xFFFE}, -2},
        Number{NumberType::uint32, WordOrder::high_first, {0x0001, 0x0002}, 65538},
        Number{NumberType::uint32, WordOrder::low_first, {0x0001, 0x0002}, 131073},
        Number{NumberType::int32, WordOrder::high_first, {0xFFFF, 0xFFFE}, -2},
        Number{NumberType::int32, WordOrder::low_first, {0xFFFE, 0xFFFF}, -2},
        Number{NumberType::float32, WordOrder::high_first, {0x4048, 0xF5C3}, 3.140000104904175},
        Number{NumberType::float32, WordOrder::low_first, {0xF5C3, 0x4048}, 3.140000104904175},
        Number{NumberType::float64, WordOrder::high_first, {0x40C8, 0x1CD6, 0xC8B4, 0x3958}, 12345.678},
        Number{NumberType::float64, WordOrder::low_first, {0x3958, 0xC8B4, 0x1CD6, 0x40C8}, 12345.678},
        Number{NumberType::uint16, {WordOrder::high_first, ByteOrder::low_first}, {0x0102}, 0x0201},
        Number{NumberType::uint16, {WordOrder::high_first, ByteOrder::low_first_in_long}, {0x0102}, 0x0102},
        Number{NumberType::uint32, {WordOrder::low_first, ByteOrder::low_first_in_long}, {2, 1}, 0x01000200}));

TEST(NumberCodecRoundTrip, EncodesWholeNumbersInEveryType) {
  for (const RegisterOrder order : {RegisterOrder(WordOrder::high_first), RegisterOrder(WordOrder::low_first),
                                    RegisterOrder(WordOrder::low_first, ByteOrder::low_first),
                                    RegisterOrder(WordOrder::high_first, ByteOrder::low_first_in_long)}) {
    for (const NumberType type : {NumberType::uint16, NumberType::int16, NumberType::uint32, NumberType::int32,
                                  NumberType::float32, NumberType::float64}) {
      std::array<std::uint16_t, 4> words{};
      encode_whole(12345, type, order, words);
      EXPECT_EQ(decode_number(words, type, order), 12345);
    }
  }
}

TEST(NumberCodecRoundTrip, TakesWhatIsNoSequenceAsNone) {
  const NumberField field{true, 0, NumberType::float32, 1};
  for (const float value : {-1.0F, 1e20F, std::numeric_limits<float>::quiet_NaN()}) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const Words words = {static_cast<std::uint16_t>(bits >> 16U), static_cast<std::uint16_t>(bits & 0xFFFFU)};
    EXPECT_EQ(decode_whole(words, 0, field, WordOrder::high_first), 0U);
  }
}

void put_double_at(Words& words, std::size_t at, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (std::size_t word = 0; word < 4; ++word)
    words[at + word] = static_cast<std::uint16_t>(bits >> (48U - 16U * word));
}

Words record_words(std::uint32_t sequence) {
  Words words(cmm_map_v1::kRecordSize);
  words[0] = static_cast<std::uint16_t>(sequence >> 16U);
  words[1] = static_cast<std::uint16_t>(sequence & 0xFFFFU);
  put_double_at(words, 2, 1.5);
  put_double_at(words, 6, -2.5);
  put_double_at(words, 10, 1e-3);
  words[16] = static_cast<std::uint16_t>(-32767);
  words[17] = 42;
  words[19] = crc16(std::span<const std::uint16_t>(words).first(19));
  return words;
}

void seal(Words& words) { words[19] = crc16(std::span<const std::uint16_t>(words).first(19)); }

TEST(CmmRecord, DecodesMapV1) {
  ProbePoint point;
  ASSERT_EQ(decode_record(record_words(70000), CmmMap{}, 70000, point).message, "");
  EXPECT_EQ(point.sequence, 70000U);
  EXPECT_EQ(point.position, (std::array<double, 3>{1.5, -2.5, 1e-3}));
  EXPECT_EQ(point.approach, (std::array<double, 3>{0, 0, -1}));
  EXPECT_EQ(point.path, 42);
}

TEST(CmmRecord, DecodesAnotherMap) {
  CmmMap map;
  map.word_order = WordOrder::low_first;
  map.record_size = 8;
  map.sequence = {true, 0, NumberType::uint16, 1};
  map.position = {NumberField{true, 1, NumberType::int32, 0.001}, NumberField{true, 3, NumberType::int32, 0.001},
                  NumberField{true, 5, NumberType::float32, 25.4}};
  for (NumberField& field : map.direction) field.present = false;
  map.path.present = map.record_status.present = map.crc.present = false;
  const Words words = {7, 0x0001, 0x0002, 0xFFFF, 0xFFFF, 0x0000, 0x3F80, 0};
  ProbePoint point;
  ASSERT_EQ(decode_record(words, map, 7, point).message, "");
  EXPECT_DOUBLE_EQ(point.position[0], 131.073);
  EXPECT_DOUBLE_EQ(point.position[1], -0.001);
  EXPECT_DOUBLE_EQ(point.position[2], 25.4);
  EXPECT_EQ(point.approach, (std::array<double, 3>{}));
}

TEST(CmmRecord, RefusesEveryChangedBit) {
  for (std::size_t bit = 0; bit < 16U * cmm_map_v1::kRecordSize; ++bit) {
    Words words = record_words(9);
    words[bit / 16] = static_cast<std::uint16_t>(words[bit / 16] ^ (1U << bit % 16));
    ProbePoint point;
    EXPECT_NE(decode_record(words, CmmMap{}, 9, point).message, "") << bit;
    EXPECT_EQ(point.sequence, 0U);
  }
}

TEST(CmmRecord, SaysWhatIsWrong) {
  ProbePoint point;
  EXPECT_EQ(decode_record(record_words(8), CmmMap{}, 9, point).message, "record 9: its place holds record 8");
  Words words = record_words(9);
  words[18] = 3;
  seal(words);
  EXPECT_EQ(decode_record(words, CmmMap{}, 9, point).message, "record 9: the device marks it as bad, status 3");
  words = record_words(9);
  put_double_at(words, 6, std::numeric_limits<double>::infinity());
  seal(words);
  EXPECT_EQ(decode_record(words, CmmMap{}, 9, point).message, "record 9: y is not a finite number");
  words = record_words(9);
  words[14] = 20000;
  seal(words);
  EXPECT_NE(decode_record(words, CmmMap{}, 9, point).message.find("its direction has the length 1.17"),
            std::string::npos);
}

Words header() {
  Words words(cmm_map_v1::kHeaderSize);
  words[0] = 1;
  words[1] = 18;
  words[3] = 5;
  words[4] = 512;
  words[5] = 20;
  words[7] = 77;
  put_double_at(words, 8, 12345.678);
  return words;
}

TEST(CmmHeader, DecodesMapV1) {
  EXPECT_EQ(header_block(CmmMap{}).first, 0);
  EXPECT_EQ(header_block(CmmMap{}).count, 12);
  const CmmHeader decoded = decode_header(header(), CmmMap{});
  EXPECT_EQ(decoded.newest, 5U);
  EXPECT_EQ(decoded.capacity, 512U);
  EXPECT_EQ(decoded.run_id, 77U);
  EXPECT_EQ(check_header(decoded, CmmMap{}).message, "");
}

struct WrongHeader {
  std::size_t at;
  std::uint16_t word;
  const char* error;
};

class CmmHeaderErrors : public ::testing::TestWithParam<WrongHeader> {};

TEST_P(CmmHeaderErrors, NameTheFix) {
  Words words = header();
  words[GetParam().at] = GetParam().word;
  EXPECT_NE(check_header(decode_header(words, CmmMap{}), CmmMap{}).message.find(GetParam().error), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, CmmHeaderErrors,
                         ::testing::Values(WrongHeader{0, 2, "register map version 2, not 1"},
                                           WrongHeader{4, 0, "set ring_capacity"},
                                           WrongHeader{4, 65535, "beyond 65535"},
                                           WrongHeader{5, 21, "its records have 21 registers"},
                                           WrongHeader{8, 0x3FC8, "its test constant reads"}));

TEST(CmmHeader, TellsTheOtherWordOrder) {
  Words words = header();
  std::reverse(words.begin() + 8, words.end());
  EXPECT_NE(check_header(decode_header(words, CmmMap{}), CmmMap{}).message.find("set word_order = \"low_first\""),
            std::string::npos);
  std::fill(words.begin() + 8, words.end(), std::uint16_t{0});
  EXPECT_EQ(check_header(decode_header(words, CmmMap{}), CmmMap{}).message, "");
}

TEST(CmmMapCheck, FindsContradictions) {
  EXPECT_EQ(check_map(CmmMap{}).message, "");
  CmmMap map;
  map.crc.address = 20;
  EXPECT_NE(check_map(map).message.find("crc ends at offset 20"), std::string::npos);
  map = {};
  map.crc = {true, 18, NumberType::uint32, 1};
  EXPECT_NE(check_map(map).message.find("crc is not a uint16"), std::string::npos);
  map = {};
  map.run_id.address = 130;
  EXPECT_NE(check_map(map).message.find("span 132 registers"), std::string::npos);
  map = {};
  map.sequence.present = false;
  EXPECT_NE(check_map(map).message.find("sequence is missing"), std::string::npos);
  map = {};
  map.direction[1].present = false;
  EXPECT_NE(check_map(map).message.find("i, j and k"), std::string::npos);
  map = {};
  map.capacity.present = false;
  EXPECT_NE(check_map(map).message.find("ring_capacity is missing"), std::string::npos);
}

TEST(ModbusFrame, EncodesRequests) {
  const auto bytes = [](const ModbusRequest& request) {
    const ModbusPdu pdu = encode_request(request);
    return std::vector<std::uint8_t>(pdu.view().begin(), pdu.view().end());
  };
  EXPECT_EQ(bytes({4, 100, 120, {}}), (std::vector<std::uint8_t>{4, 0, 100, 0, 120}));
  EXPECT_EQ(bytes({6, 2, 1, {3}}), (std::vector<std::uint8_t>{6, 0, 2, 0, 3}));
  EXPECT_EQ(bytes({16, 0, 2, {1, 0x0203}}), (std::vector<std::uint8_t>{16, 0, 0, 0, 2, 4, 0, 1, 2, 3}));
}

TEST(ModbusFrame, MatchesRepliesWithTheirRequest) {
  std::array<std::uint16_t, 4> registers{};
  std::string fault;
  const ModbusRequest read{4, 0, 2, {}};
  const auto match = [&](const std::vector<std::uint8_t>& reply, const ModbusRequest& request) {
    return match_reply(reply, request, registers, fault);
  };
  EXPECT_EQ(match({4, 4, 1, 2, 3, 4}, read), ReplyKind::good);
  EXPECT_EQ(registers[1], 0x0304);
  EXPECT_EQ(match({4, 2, 1, 2}, read), ReplyKind::foreign);
  EXPECT_EQ(match({3, 4, 1, 2, 3, 4}, read), ReplyKind::foreign);
  EXPECT_EQ(match({4, 5, 1, 2, 3, 4}, read), ReplyKind::foreign);
  EXPECT_EQ(match({}, read), ReplyKind::foreign);
  EXPECT_EQ(match({0x84, 2}, read), ReplyKind::absent);
  EXPECT_NE(fault.find("Illegal data address"), std::string::npos) << fault;
  EXPECT_EQ(match({0x84, 4}, read), ReplyKind::refused);
  EXPECT_EQ(match({0x84, 1}, read), ReplyKind::unknown);
  EXPECT_EQ(match({0x84, 5}, read), ReplyKind::busy);
  EXPECT_EQ(match({0x84, 6}, read), ReplyKind::busy);
  EXPECT_EQ(match({16, 0, 0, 0, 2}, {16, 0, 2, {1, 2}}), ReplyKind::good);
  EXPECT_EQ(match({16, 0, 1, 0, 2}, {16, 0, 2, {1, 2}}), ReplyKind::foreign);
  EXPECT_EQ(match({6, 0, 2, 0, 3}, {6, 2, 1, {3}}), ReplyKind::good);
  EXPECT_EQ(match({6, 0, 2, 0, 1}, {6, 2, 1, {3}}), ReplyKind::foreign);
}

}  // namespace
}  // namespace bladefit
