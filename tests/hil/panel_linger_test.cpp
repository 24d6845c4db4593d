// The panel of a session that is over, as an HMI reads it.
#include <gtest/gtest.h>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// The characters in registers, up to the first zero.
std::string ascii(const std::vector<std::uint16_t>& registers) {
  std::string text;
  for (const std::uint16_t word : registers) {
    for (const int byte : {word >> 8, word & 0xFF}) {
      if (byte == 0) return text;
      text += static_cast<char>(byte);
    }
  }
  return text;
}

class LingeringSession {
 public:
  explicit LingeringSession(const std::string& panel_keys)
      : machine_(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "0"})) {
    std::ofstream(scratch_ / "session.toml") << "[panel]\nlinger = 60\n" << panel_keys;
    run_.emplace(run_options(source_of(Link::modbus_tcp, machine_.address()), scratch_ / "session",
                             scratch_ / "result.json", {"--headless", "--config", scratch_ / "session.toml"}));
  }

  Process& run() { return *run_; }

  [[nodiscard]] bool ends() const {
    const RawModbus panel = RawModbus::tcp(panel_port(*run_));
    return eventually([&] { return panel.inputs(289, 1) == std::vector<std::uint16_t>{1}; }, 20s);
  }

  [[nodiscard]] nlohmann::json result() const { return testing::read_json(scratch_ / "result.json"); }

 private:
  ScratchFolder scratch_;
  SimulatedMachine machine_;
  std::optional<Process> run_;
};

TEST(PanelLinger, KeepsTheResultUntilToldToStop) {
  LingeringSession session("");
  ASSERT_TRUE(session.ends());
  ASSERT_TRUE(session.run().wait_for("shows the result for 60 s", 20s));
  const RawModbus panel = RawModbus::tcp(panel_port(session.run()));
  EXPECT_EQ(panel.inputs(281, 1).at(0), 2) << "out of tolerance";
  EXPECT_EQ(ascii(panel.inputs(300, 40)).find("OUT OF TOLERANCE"), 0U);
  EXPECT_EQ(ascii(panel.inputs(340, 40)).find("point "), 0U);
  EXPECT_EQ(ascii(panel.inputs(380, 40)), "cut or weld the points marked, then probe them again");
  std::array<std::uint8_t, 16> inputs{};
  ASSERT_EQ(modbus_read_input_bits(panel.context(), 0, 16, inputs.data()), 16);
  EXPECT_EQ(inputs, (std::array<std::uint8_t, 16>{1, 1, 0, 1, 0, 0, 1}));
  EXPECT_EQ(session.result().at("verdict").at("state"), "out_of_tolerance") << "the files are there already";
  session.run().signal(SIGINT);
  EXPECT_EQ(session.run().exit_code(5s), 1) << "as without the wait";
}

TEST(PanelLinger, NumbersAreSentAsTheSettingsSay) {
  LingeringSession session("word_order = \"low_first\"\ninfinity = -1.0\n");
  ASSERT_TRUE(session.ends());
  const RawModbus panel = RawModbus::tcp(panel_port(session.run()));
  EXPECT_EQ(panel.inputs(285, 2), (std::vector<std::uint16_t>{0x5678, 0x1234}));
  EXPECT_EQ(panel.inputs(4, 2), (std::vector<std::uint16_t>{200, 0}));
  EXPECT_EQ(panel.inputs(504, 2), (std::vector<std::uint16_t>{200, 0}));
}

}  // namespace
}  // namespace bladefit::hil
