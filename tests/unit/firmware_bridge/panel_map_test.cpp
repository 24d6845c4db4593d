// The panel map, register by register.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "firmware_bridge/host/panel/panel_map.hpp"
#include "firmware_bridge/host/panel/panel_texts.hpp"
#include "tests/support/panel_state.hpp"

namespace bladefit {
namespace {

using testing::known_state;

std::uint32_t wide(const PanelImage& image, std::size_t address) {
  return static_cast<std::uint32_t>(image.registers[address]) << 16U | image.registers[address + 1];
}
float real(const PanelImage& image, std::size_t address) { return std::bit_cast<float>(wide(image, address)); }

std::span<const std::uint16_t, kPanelRegisters> first_registers(const PanelImage& image) {
  return std::span(image.registers).first<kPanelRegisters>();
}
std::span<const std::uint16_t> extension_of(const PanelImage& image) {
  return std::span(image.registers).subspan(kExtensionBase, kExtensionRegisters);
}

/// The first discrete inputs as given, the others off.
std::array<bool, kPanelDiscreteInputs> first_inputs(std::initializer_list<bool> inputs) {
  std::array<bool, kPanelDiscreteInputs> all{};
  std::copy(inputs.begin(), inputs.end(), all.begin());
  return all;
}

TEST(BridgePanelMap, PutsCountsWhereTheContractSays) {
  const PanelImage image = encode_panel(known_state(), {});
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
  const PanelImage image = encode_panel(known_state(), {});
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
  const PanelImage image = encode_panel(known_state(), {});
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
  const PanelImage image = encode_panel(known_state(), {});
  for (std::size_t place = 0; place < kPanelPlaces; ++place) {
    const auto number = static_cast<float>(place);
    EXPECT_EQ(wide(image, 60 + 4 * place), 80000U + place);
    EXPECT_EQ(real(image, 62 + 4 * place), 0.5F + number);
    const auto* words = image.registers.data() + 200 + 8 * place;
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
  const PanelImage image = encode_panel(state, {});
  EXPECT_EQ(image.registers[264], 1);
  EXPECT_EQ(image.registers[266], 118);
  EXPECT_EQ(image.registers[267], 1);
  EXPECT_EQ(image.registers[268], 70000 - 65536);
  PanelState read;
  ASSERT_TRUE(decode_panel(first_registers(image), extension_of(image), {}, read));
  EXPECT_TRUE(read.improving);
  EXPECT_EQ(read.support, state.support);
}

TEST(BridgePanelMap, NamesThePointsThatARobustFitJudgesOtherwise) {
  PanelState state;
  state.reasons = kReasonOtherwise;
  state.otherwise_count = 65537;
  state.otherwise = {118, 70000};
  const PanelImage image = encode_panel(state, {});
  EXPECT_EQ(image.registers[282], 1U << 10U);
  EXPECT_EQ(image.registers[1150], 1);
  EXPECT_EQ(image.registers[1151], 1);
  EXPECT_EQ(image.registers[1153], 118);
  EXPECT_EQ(image.registers[1155], 70000 - 65536);
  EXPECT_EQ(image.registers[1157], 0);
}

TEST(BridgePanelMap, DiscreteInputsFollowTheState) {
  PanelState state;
  EXPECT_EQ(encode_panel(state, {}).discrete, first_inputs({false, false, false, false, false, true}));
  state.rest_out = 1;
  EXPECT_EQ(encode_panel(state, {}).discrete, first_inputs({false, true, false, false, false, true}));
  state.leading_edge_out = 1;
  state.alarms = kAlarmLinkLost;
  state.fit_determined = true;
  EXPECT_EQ(encode_panel(state, {}).discrete, first_inputs({true, true, true, true, false, true}));
  state.verdict = BladeState::in_tolerance;
  EXPECT_TRUE(encode_panel(state, {}).discrete[4]);
  EXPECT_FALSE(encode_panel(state, {}).discrete[5]);
  EXPECT_FALSE(encode_panel(state, {}).discrete[6]);
  state.ended = true;
  EXPECT_TRUE(encode_panel(state, {}).discrete[6]);
}

TEST(BridgePanelMap, SaysWhetherTheSessionHasEndedAndWhatWasPlanned) {
  PanelState state;
  state.planned = 70287;
  state.ended = true;
  const PanelImage image = encode_panel(state, {});
  EXPECT_EQ(wide(image, 287), 70287U);
  EXPECT_EQ(image.registers[289], 1);
  PanelState read;
  ASSERT_TRUE(decode_panel(first_registers(image), extension_of(image), {}, read));
  EXPECT_EQ(read.planned, 70287U);
  EXPECT_TRUE(read.ended);
}

TEST(BridgePanelMap, SendsTextsAsAscii) {
  PanelState state;
  state.texts = {"OUT", "point 7 \xC3\xA4", std::string(100, 'x')};
  const PanelImage image = encode_panel(state, {});
  EXPECT_EQ(image.registers[300], 'O' << 8 | 'U');
  EXPECT_EQ(image.registers[301], 'T' << 8);
  EXPECT_EQ(image.registers[302], 0);
  EXPECT_EQ(image.registers[344], '?' << 8 | '?');
  EXPECT_EQ(image.registers[419], 'x' << 8 | 'x');
  EXPECT_EQ(image.registers[420], 0) << "a text stays in its place";
}

TEST(BridgePanelMap, TwinsAreWholeNumbers) {
  PanelState state = known_state();
  state.rest_tolerance = 1e9F;
  state.worst_rest = -1e9F;
  const PanelImage image = encode_panel(state, {});
  const auto twin = [&](std::size_t address) { return static_cast<std::int32_t>(wide(image, address)); };
  for (const std::size_t word : {0U, 1U, 2U, 3U, 42U, 43U, 44U, 51U, 54U}) {
    EXPECT_EQ(image.registers[500 + word], image.registers[word]) << word;
  }
  for (const std::size_t number : {4U, 6U, 8U, 10U, 12U, 20U, 24U, 38U, 60U, 88U}) {
    EXPECT_EQ(wide(image, 500 + number), wide(image, number)) << number;
  }
  EXPECT_EQ(twin(514), 14) << "micrometres";
  EXPECT_EQ(twin(518), -18);
  EXPECT_EQ(twin(526), 26000);
  EXPECT_EQ(twin(532), 32000000) << "microradians";
  EXPECT_EQ(twin(549), 5) << "microseconds";
  EXPECT_EQ(twin(562), 500);
  EXPECT_EQ(twin(590), 7500);
  EXPECT_EQ(twin(547), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(twin(522), std::numeric_limits<std::int32_t>::min());
}

TEST(BridgePanelMap, TheLowWordComesFirstWhereTheFormatSaysSo) {
  const PanelImage image = encode_panel(known_state(), {.low_word_first = true});
  EXPECT_EQ(image.registers[4], 70001 - 65536);
  EXPECT_EQ(image.registers[5], 1);
  EXPECT_EQ(image.registers[283], 0xE6B6);
  EXPECT_EQ(image.registers[284], 0x4640);
  EXPECT_EQ(image.registers[285], 0x5678);
  EXPECT_EQ(image.registers[504], 70001 - 65536);
  EXPECT_EQ(image.registers[3], kAlarmLeadingEdgeOut | kAlarmLinkLost) << "a single register stays";
  PanelState read;
  ASSERT_TRUE(decode_panel(first_registers(image), extension_of(image), {}, read));
  EXPECT_EQ(read.points, 70001U);
  EXPECT_EQ(read.worst_leading_edge, -0.018F);
}

TEST(BridgePanelMap, InfinityIsSentAsTheFormatSays) {
  PanelState state;
  state.leading_edge_tolerance = 0.1F;
  state.rest_tolerance = std::numeric_limits<float>::infinity();
  state.last_distance = std::numeric_limits<float>::quiet_NaN();
  state.reasons = kReasonNoTolerance;
  for (const float infinity : {0.0F, 9999.0F, -1.0F, std::numeric_limits<float>::infinity()}) {
    const PanelImage image = encode_panel(state, {.infinity = infinity});
    EXPECT_EQ(real(image, 45), 0.1F);
    EXPECT_EQ(real(image, 47), infinity);
    EXPECT_EQ(real(image, 40), infinity);
    EXPECT_EQ(image.registers[282], 512);
    PanelState read;
    ASSERT_TRUE(decode_panel(first_registers(image), extension_of(image), {}, read));
    EXPECT_EQ(read.leading_edge_tolerance, 0.1F);
    EXPECT_EQ(read.rest_tolerance, std::numeric_limits<float>::infinity());
  }
}

TEST(BridgePanelTexts, AreShortAndSayWhatToDo) {
  PanelState state = known_state();
  EXPECT_EQ(verdict_words(state), "OUT OF TOLERANCE: points missing");
  EXPECT_EQ(advice_words(state), "cut or weld the points marked, then probe them again");
  state.reasons = kReasonLinkLost;
  EXPECT_EQ(advice_words(state), "link lost: check the cable and the machine");
  state.verdict = BladeState::not_decided;
  state.reasons = kReasonZoneNotProbed | kReasonOpen;
  EXPECT_EQ(advice_words(state), "probe the leading edge");
  state.verdict = BladeState::in_tolerance;
  state.reasons = 0;
  EXPECT_EQ(advice_words(state), "nothing: the blade is in tolerance");
  Verdict worst;
  worst.sequence = 1312;
  worst.region = Region::leading_edge;
  worst.action = Action::weld;
  worst.foot.distance = -0.3234;
  worst.foot.u = 0.4839;
  worst.foot.v = 0.648;
  EXPECT_EQ(worst_words(&worst, 117.04), "point 1312 leading edge -0.323 mm WELD radius 117.0 mm u 0.4839 v 0.6480");
  worst.sequence = std::numeric_limits<std::uint32_t>::max();
  EXPECT_LE(worst_words(&worst, 117.04).size(), 80U);
  EXPECT_EQ(worst_words(nullptr, 0), "");
}

TEST(BridgePanelMap, VerdictReasonsAndTestNumbersStandInTheExtension) {
  PanelState state;
  state.verdict = BladeState::out_of_tolerance;
  Reasons reasons;
  for (const Reason reason : {Reason::points_refused, Reason::unfinished, Reason::mirrored}) reasons.add(reason);
  state.reasons = reason_bits(reasons);
  EXPECT_EQ(state.reasons, 8 + 32 + 128);
  const PanelImage image = encode_panel(state, {});
  EXPECT_EQ(image.registers[281], 2);
  EXPECT_EQ(image.registers[282], 8 + 32 + 128);
  EXPECT_EQ(image.registers[283], 0x4640);  // 12345.678 as float32: 46 40 E6 B6
  EXPECT_EQ(image.registers[284], 0xE6B6);
  EXPECT_EQ(image.registers[285], 0x1234);
  EXPECT_EQ(image.registers[286], 0x5678);
  PanelState read;
  ASSERT_TRUE(decode_panel(first_registers(image), extension_of(image), {}, read));
  EXPECT_EQ(read.verdict, state.verdict);
  EXPECT_EQ(read.reasons, state.reasons);
}

TEST(BridgePanelMap, ReadsBackWhatItWrites) {
  const PanelImage image = encode_panel(known_state(), {});
  PanelState state;
  const auto blade = std::span(image.registers).subspan(kBladeBase, kBladeRegisters);
  ASSERT_TRUE(decode_panel(first_registers(image), extension_of(image), blade, state));
  EXPECT_EQ(encode_panel(state, {}).registers, image.registers);
  EXPECT_TRUE(state.has_extension);
  ASSERT_TRUE(decode_panel(first_registers(image), {}, {}, state));
  EXPECT_FALSE(state.has_extension);
  PanelImage foreign = image;
  foreign.registers[0] = 2;
  EXPECT_FALSE(decode_panel(first_registers(foreign), extension_of(image), {}, state));
}

}  // namespace
}  // namespace bladefit
