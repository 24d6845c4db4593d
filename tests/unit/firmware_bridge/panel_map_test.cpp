// The panel map, register by register, and the answers to requests.
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "firmware_bridge/host/panel/panel_map.hpp"
#include "firmware_bridge/host/panel/panel_protocol.hpp"
#include "tests/support/panel_state.hpp"

namespace bladefit {
namespace {

using testing::known_state;

std::uint32_t wide(const PanelImage& image, std::size_t address) {
  return static_cast<std::uint32_t>(image.registers[address]) << 16U | image.registers[address + 1];
}
float real(const PanelImage& image, std::size_t address) { return std::bit_cast<float>(wide(image, address)); }

TEST(BridgePanelMap, PutsCountsWhereTheContractSays) {
  const PanelImage image = encode_panel(known_state());
  EXPECT_EQ(image.registers[0], 1);
  EXPECT_EQ(image.registers[1], 3);
  EXPECT_EQ(image.registers[2], 1);
  EXPECT_EQ(image.registers[3], kAlarmLeadingEdgeOut | kAlarmLinkLost);
  EXPECT_EQ(wide(image, 4), 70001U);
  EXPECT_EQ(wide(image, 6), 70002U);
  EXPECT_EQ(wide(image, 8), 70003U);
  EXPECT_EQ(wide(image, 10), 70004U);
  EXPECT_EQ(wide(image, 12), 70005U);
}

TEST(BridgePanelMap, PutsTheFitWhereTheContractSays) {
  const PanelImage image = encode_panel(known_state());
  EXPECT_EQ(real(image, 14), 0.014F);
  EXPECT_EQ(real(image, 16), 0.016F);
  EXPECT_EQ(real(image, 18), -0.018F);
  EXPECT_EQ(wide(image, 20), 70020U);
  EXPECT_EQ(real(image, 22), 0.022F);
  EXPECT_EQ(wide(image, 24), 70024U);
  for (std::size_t entry = 0; entry < 6; ++entry) {
    EXPECT_EQ(real(image, 26 + 2 * entry), 26.0F + 2.0F * static_cast<float>(entry));
  }
  EXPECT_EQ(image.registers[54], 6);
}

TEST(BridgePanelMap, PutsTheLastPointAndTolerancesWhereTheContractSays) {
  const PanelImage image = encode_panel(known_state());
  EXPECT_EQ(wide(image, 38), 70038U);
  EXPECT_EQ(real(image, 40), 0.040F);
  EXPECT_EQ(image.registers[42], 2);
  EXPECT_EQ(image.registers[43], 1);
  EXPECT_EQ(image.registers[44], 1);
  EXPECT_EQ(real(image, 45), 0.045F);
  EXPECT_EQ(real(image, 47), 0.047F);
  EXPECT_EQ(real(image, 49), 4.9F);
  EXPECT_EQ(image.registers[51], 51);
  EXPECT_EQ(real(image, 52), 0.0F);
  for (std::size_t address = 55; address < 60; ++address) EXPECT_EQ(image.registers[address], 0);
}

TEST(BridgePanelMap, PutsTheNewestPointsWhereTheContractSays) {
  const PanelImage image = encode_panel(known_state());
  for (std::size_t place = 0; place < kPanelPlaces; ++place) {
    const auto number = static_cast<float>(place);
    EXPECT_EQ(wide(image, 60 + 4 * place), 80000U + place);
    EXPECT_EQ(real(image, 62 + 4 * place), 0.5F + number);
    const auto* words = image.extension.data() + place * kPlaceRegisters;
    const auto at = [words](std::size_t offset) {
      return std::bit_cast<float>(static_cast<std::uint32_t>(words[offset]) << 16U | words[offset + 1]);
    };
    EXPECT_EQ(words[0], place);
    EXPECT_EQ(at(1), 0.1F * number);
    EXPECT_EQ(at(3), 0.2F * number);
    EXPECT_EQ(at(5), 100.0F + number);
    EXPECT_EQ(words[7], place % 2 == 0 ? 1 : 2);
  }
}

TEST(BridgePanelMap, NamesThePointsThatProveTheSmallestTolerance) {
  PanelState state;
  state.improving = true;
  state.support = {118, 70000, 3};
  const PanelImage image = encode_panel(state);
  EXPECT_EQ(image.extension[64], 1);
  EXPECT_EQ(image.extension[66], 118);
  EXPECT_EQ(image.extension[67], 1);
  EXPECT_EQ(image.extension[68], 70000 - 65536);
  PanelState read;
  ASSERT_TRUE(decode_panel(image.registers, image.extension, read));
  EXPECT_TRUE(read.improving);
  EXPECT_EQ(read.support, state.support);
}

TEST(BridgePanelMap, DiscreteInputsFollowTheState) {
  PanelState state;
  EXPECT_EQ(encode_panel(state).discrete, (std::array<bool, 8>{false, false, false, false, false, true}));
  state.rest_out = 1;
  EXPECT_EQ(encode_panel(state).discrete, (std::array<bool, 8>{false, true, false, false, false, true}));
  state.leading_edge_out = 1;
  state.alarms = kAlarmLinkLost;
  state.fit_determined = true;
  EXPECT_EQ(encode_panel(state).discrete, (std::array<bool, 8>{true, true, true, true, false, true}));
  state.verdict = BladeState::in_tolerance;
  EXPECT_TRUE(encode_panel(state).discrete[4]);
  EXPECT_FALSE(encode_panel(state).discrete[5]);
}

TEST(BridgePanelMap, VerdictReasonsAndTestNumbersStandInTheExtension) {
  PanelState state;
  state.verdict = BladeState::out_of_tolerance;
  Reasons reasons;
  for (const Reason reason : {Reason::points_refused, Reason::unfinished, Reason::mirrored}) reasons.add(reason);
  state.reasons = reason_bits(reasons);
  EXPECT_EQ(state.reasons, 8 + 32 + 128);
  const PanelImage image = encode_panel(state);
  EXPECT_EQ(image.extension[281 - kPlaceBase], 2);
  EXPECT_EQ(image.extension[282 - kPlaceBase], 8 + 32 + 128);
  EXPECT_EQ(image.extension[283 - kPlaceBase], 0x4640);  // 12345.678 as float32: 46 40 E6 B6
  EXPECT_EQ(image.extension[284 - kPlaceBase], 0xE6B6);
  EXPECT_EQ(image.extension[285 - kPlaceBase], 0x1234);
  EXPECT_EQ(image.extension[286 - kPlaceBase], 0x5678);
  PanelState read;
  ASSERT_TRUE(decode_panel(image.registers, image.extension, read));
  EXPECT_EQ(read.verdict, state.verdict);
  EXPECT_EQ(read.reasons, state.reasons);
}

TEST(BridgePanelMap, ReadsBackWhatItWrites) {
  const PanelImage image = encode_panel(known_state());
  PanelState state;
  ASSERT_TRUE(decode_panel(image.registers, image.extension, state));
  EXPECT_EQ(encode_panel(state).registers, image.registers);
  EXPECT_EQ(encode_panel(state).extension, image.extension);
  EXPECT_TRUE(state.has_extension);
  ASSERT_TRUE(decode_panel(image.registers, {}, state));
  EXPECT_FALSE(state.has_extension);
  PanelImage foreign = image;
  foreign.registers[0] = 2;
  EXPECT_FALSE(decode_panel(foreign.registers, image.extension, state));
}

using Bytes = std::vector<std::uint8_t>;

Bytes answer(const Bytes& request, bool commands_enabled = false) {
  PanelCommands commands;
  return answer_panel_request(request, encode_panel(known_state()), commands_enabled, commands);
}

TEST(BridgePanelProtocol, AnswersReadsInsideTheMapOnly) {
  EXPECT_EQ(answer({4, 0, 0, 0, 2}), (Bytes{4, 4, 0, 1, 0, 3}));
  EXPECT_EQ(answer({4, 0, 0, 0, 92}).size(), 2U + 2 * 92);
  EXPECT_EQ(answer({4, 0, 200, 0, 87}).size(), 2U + 2 * 87);
  EXPECT_EQ(answer({2, 0, 0, 0, 8}), (Bytes{2, 1, 0b1111}));
  EXPECT_EQ(answer({2, 0, 2, 0, 1}), (Bytes{2, 1, 1}));
  EXPECT_EQ(answer({4, 0, 91, 0, 2}), (Bytes{0x84, 2}));
  EXPECT_EQ(answer({4, 0, 92, 0, 1}), (Bytes{0x84, 2}));
  EXPECT_EQ(answer({4, 0, 199, 0, 1}), (Bytes{0x84, 2}));
  EXPECT_EQ(answer({4, 0, 200, 0, 88}), (Bytes{0x84, 2}));
  EXPECT_EQ(answer({4, 0xFF, 0xFF, 0, 1}), (Bytes{0x84, 2}));
  EXPECT_EQ(answer({4, 0, 0, 0, 0}), (Bytes{0x84, 3}));
  EXPECT_EQ(answer({4, 0, 0, 0, 126}), (Bytes{0x84, 3}));
  EXPECT_EQ(answer({4, 0, 0, 0}), (Bytes{0x84, 3}));
  EXPECT_EQ(answer({2, 0, 1, 0, 8}), (Bytes{0x82, 2}));
}

TEST(BridgePanelProtocol, RefusesWritesAndForeignFunctions) {
  for (const std::uint8_t function : Bytes{5, 6, 7, 15, 16, 22, 23, 43, 127}) {
    EXPECT_EQ(answer({function, 0, 0, 0xFF, 0}), (Bytes{static_cast<std::uint8_t>(function | 0x80U), 1}));
  }
  EXPECT_EQ(answer({1, 0, 0, 0, 4}), (Bytes{0x81, 1}));
  EXPECT_EQ(answer({3, 0, 0, 0, 1}), (Bytes{0x83, 2}));
  EXPECT_EQ(answer({6, 0, 0, 0, 1}, true), (Bytes{0x86, 1}));
}

TEST(BridgePanelProtocol, CoilsAreCommandsWhereTheyAreEnabled) {
  PanelCommands commands;
  const PanelImage image = encode_panel(known_state());
  const Bytes stop = {5, 0, 1, 0xFF, 0};
  EXPECT_EQ(answer_panel_request(stop, image, true, commands), stop);
  EXPECT_TRUE(commands.stop);
  EXPECT_FALSE(commands.start || commands.reset || commands.acknowledge);
  commands = {};
  EXPECT_EQ(answer_panel_request(Bytes{15, 0, 2, 0, 2, 1, 0b11}, image, true, commands), (Bytes{15, 0, 2, 0, 2}));
  EXPECT_TRUE(commands.reset && commands.acknowledge);
  EXPECT_FALSE(commands.start || commands.stop);
  commands = {};
  EXPECT_EQ(answer_panel_request(Bytes{5, 0, 1, 0, 0}, image, true, commands), (Bytes{5, 0, 1, 0, 0}));
  EXPECT_FALSE(commands.stop);
  EXPECT_EQ(answer({5, 0, 4, 0xFF, 0}, true), (Bytes{0x85, 2}));
  EXPECT_EQ(answer({5, 0, 0, 0x12, 0}, true), (Bytes{0x85, 3}));
  EXPECT_EQ(answer({15, 0, 0, 0, 5, 1, 1}, true), (Bytes{0x8F, 2}));
  EXPECT_EQ(answer({15, 0, 0, 0, 4, 2, 1}, true), (Bytes{0x8F, 3}));
  EXPECT_EQ(answer({1, 0, 0, 0, 4}, true), (Bytes{1, 1, 0}));
}

TEST(BridgePanelProtocol, BearsAnyBytes) {
  std::mt19937 random(7);
  const PanelImage image = encode_panel(known_state());
  for (int round = 0; round < 20000; ++round) {
    Bytes request(1 + random() % kLongestPdu);
    for (std::uint8_t& byte : request) byte = static_cast<std::uint8_t>(random());
    if (round % 2 == 0) request[0] = static_cast<std::uint8_t>(1 + random() % 16);
    if (round % 3 == 0) request.resize(std::min<std::size_t>(request.size(), 5));
    PanelCommands commands;
    const Bytes reply = answer_panel_request(request, image, round % 4 == 0, commands);
    ASSERT_GE(reply.size(), 2U);
    ASSERT_LE(reply.size(), kLongestPdu);
  }
}

}  // namespace
}  // namespace bladefit
