// The answers of the panel to requests, byte by byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "firmware_bridge/host/panel/panel_protocol.hpp"
#include "tests/support/panel_state.hpp"

namespace bladefit {
namespace {

using testing::known_state;

using Bytes = std::vector<std::uint8_t>;

Bytes answer(const Bytes& request, bool commands_enabled = false) {
  PanelCommands commands;
  return answer_panel_request(request, encode_panel(known_state(), {}), commands_enabled, commands);
}

TEST(BridgePanelProtocol, AnswersReadsInsideTheMapByBothFunctions) {
  for (const std::uint8_t function : Bytes{3, 4}) {
    const auto refused = [function](std::uint8_t code) {
      return Bytes{static_cast<std::uint8_t>(function | 0x80U), code};
    };
    EXPECT_EQ(answer({function, 0, 0, 0, 2}), (Bytes{function, 4, 0, 1, 0, 3}));
    for (std::uint16_t first = 0; first < 600; ++first) {
      const auto count = static_cast<std::uint8_t>(std::min(125, 600 - first));
      const Bytes reply =
          answer({function, static_cast<std::uint8_t>(first >> 8U), static_cast<std::uint8_t>(first), 0, count});
      ASSERT_EQ(reply.size(), 2U + 2U * count) << first;
    }
    EXPECT_EQ(answer({function, 0, 92, 0, 108}), [function] {
      Bytes zeros(2 + 2 * 108, 0);
      zeros[0] = function;
      zeros[1] = 2 * 108;
      return zeros;
    }()) << "what has no meaning reads 0";
    EXPECT_EQ(answer({function, 0x02, 0x57, 0, 2}), refused(2)) << "599 is the last";
    EXPECT_EQ(answer({function, 0xFF, 0xFF, 0, 1}), refused(2));
    EXPECT_EQ(answer({function, 0, 0, 0, 0}), refused(3));
    EXPECT_EQ(answer({function, 0, 0, 0, 126}), refused(3));
    EXPECT_EQ(answer({function, 0, 0, 0}), refused(3));
  }
}

TEST(BridgePanelProtocol, AnswersReadsOfBits) {
  EXPECT_EQ(answer({2, 0, 0, 0, 16}), (Bytes{2, 2, 0b1111, 0}));
  EXPECT_EQ(answer({2, 0, 2, 0, 1}), (Bytes{2, 1, 1}));
  EXPECT_EQ(answer({2, 0, 1, 0, 16}), (Bytes{0x82, 2}));
  EXPECT_EQ(answer({1, 0, 0, 0, 4}), (Bytes{1, 1, 0})) << "coils read 0";
  EXPECT_EQ(answer({1, 0, 0, 0, 16}), (Bytes{1, 2, 0, 0}));
}

TEST(BridgePanelProtocol, TellsMakerProductAndVersion) {
  const Bytes all = answer({43, 14, 1, 0});
  const std::string text(all.begin(), all.end());
  EXPECT_EQ(Bytes(all.begin(), all.begin() + 7), (Bytes{43, 14, 1, 0x81, 0, 0, 3}));
  EXPECT_EQ(text.substr(7, 10), std::string("\0\x08", 2) + "bladefit");
  EXPECT_NE(text.find("bladefit panel"), std::string::npos);
  EXPECT_EQ(answer({43, 14, 3, 9}).size(), all.size()) << "an unknown start of a stream is the first object";
  const Bytes product = answer({43, 14, 4, 1});
  EXPECT_EQ(std::string(product.begin() + 9, product.end()), "bladefit panel");
  EXPECT_EQ(answer({43, 14, 4, 3}), (Bytes{0xAB, 2}));
  EXPECT_EQ(answer({43, 14, 5, 0}), (Bytes{0xAB, 3}));
  EXPECT_EQ(answer({43, 13, 1, 0}), (Bytes{0xAB, 1}));
}

TEST(BridgePanelProtocol, RefusesWritesAndForeignFunctions) {
  for (const std::uint8_t function : Bytes{5, 6, 7, 15, 16, 22, 23, 43, 127}) {
    EXPECT_EQ(answer({function, 0, 0, 0xFF, 0}), (Bytes{static_cast<std::uint8_t>(function | 0x80U), 1}));
  }
  EXPECT_EQ(answer({6, 0, 0, 0, 1}, true), (Bytes{0x86, 1}));
}

TEST(BridgePanelProtocol, CoilsAreCommandsWhereTheyAreEnabled) {
  PanelCommands commands;
  const PanelImage image = encode_panel(known_state(), {});
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
  const PanelImage image = encode_panel(known_state(), {});
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
