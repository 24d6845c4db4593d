// Commands written to the panel, and a panel that outlives its host.
#include <gtest/gtest.h>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

constexpr int kStart = 0, kStop = 1, kReset = 2, kAcknowledge = 3;
constexpr std::uint16_t kIdle = 0;
constexpr unsigned kOutAlarms = 3;

/// A machine and a session whose panel takes commands or refuses them.
struct CommandedSession {
  explicit CommandedSession(bool commands)
      : machine(machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "100"})),
        run(options(commands)),
        panel(RawModbus::tcp(panel_port(run))) {}

  [[nodiscard]] std::vector<std::string> options(bool commands) const {
    std::ofstream(scratch / "session.toml") << "[panel]\ncommands = " << (commands ? "true" : "false") << "\n";
    return run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json",
                       {"--headless", "--config", scratch / "session.toml"});
  }
  [[nodiscard]] bool write(int coil) const { return modbus_write_bit(panel.context(), coil, 1) == 1; }
  [[nodiscard]] std::uint16_t word(int address) const { return panel.inputs(address, 1).at(0); }
  [[nodiscard]] std::uint16_t points() const { return word(5); }

  ScratchFolder scratch;
  SimulatedMachine machine;
  Process run;
  RawModbus panel;
};

TEST(RunCommands, StopStartAcknowledgeAndReset) {
  const CommandedSession session(true);
  ASSERT_TRUE(eventually([&] { return session.points() >= 100 && (session.word(3) & kOutAlarms) != 0; }, 20s));

  ASSERT_TRUE(session.write(kStop));
  ASSERT_TRUE(eventually([&] { return session.word(1) == kIdle; }, 5s));
  std::this_thread::sleep_for(200ms);
  const std::uint16_t stopped_at = session.points();
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(session.points(), stopped_at);

  ASSERT_TRUE(session.write(kAcknowledge));
  EXPECT_TRUE(eventually([&] { return (session.word(3) & kOutAlarms) == 0; }, 5s));
  EXPECT_GT(session.panel.inputs(8, 2).at(1) + session.panel.inputs(10, 2).at(1), 0) << "the points are still out";

  ASSERT_TRUE(session.write(kStart));
  EXPECT_TRUE(eventually([&] { return session.points() > stopped_at + 50; }, 10s));
  EXPECT_NE(session.word(1), kIdle);

  ASSERT_TRUE(session.write(kStop));
  ASSERT_TRUE(eventually([&] { return session.word(1) == kIdle; }, 5s));
  ASSERT_TRUE(session.write(kReset));
  EXPECT_TRUE(eventually([&] { return session.points() == 0; }, 5s));
  ASSERT_TRUE(session.write(kStart));
  EXPECT_TRUE(eventually([&] { return session.points() >= 20; }, 10s));
}

TEST(RunCommands, AreRefusedUnlessTheyAreEnabled) {
  const CommandedSession session(false);
  for (const int coil : {kStart, kStop, kReset, kAcknowledge}) {
    errno = 0;
    EXPECT_FALSE(session.write(coil));
    EXPECT_EQ(errno, EMBXILFUN) << modbus_strerror(errno);
  }
  const std::array<std::uint8_t, 4> all = {1, 1, 1, 1};
  EXPECT_EQ(modbus_write_bits(session.panel.context(), 0, 4, all.data()), -1);
  EXPECT_EQ(errno, EMBXILFUN);
  const std::uint16_t before = session.points();
  EXPECT_TRUE(eventually([&] { return session.points() > before + 20; }, 10s)) << "the session has stopped";
  EXPECT_NE(session.word(1), kIdle);
}

TEST(Panel, ConnectsAgainWhenTheHostHasComeBack) {
  const ScratchFolder scratch;
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "100"}));
  std::vector<std::string> options = run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session",
                                                 scratch / "result.json", {"--headless"});
  std::optional<Process> host(std::in_place, options);
  ASSERT_TRUE(wait_for_points(*host, 50)) << host->err();
  const std::string address = "127.0.0.1:" + std::to_string(panel_port(*host));
  Process panel({BLADEFIT_COMMAND, "panel", "--connect", address});
  ASSERT_TRUE(panel.wait_for("link up", 10s)) << panel.err();
  host->power_off();
  ASSERT_TRUE(panel.wait_for("NO ANSWER", 10s)) << panel.out();
  const std::size_t told = panel.out().size();
  *std::find(options.begin(), options.end(), "127.0.0.1:0") = address;
  host.emplace(options);
  EXPECT_TRUE(eventually([&] { return panel.out().find("link up", told) != std::string::npos; }, 20s))
      << panel.out() << host->err();
  EXPECT_TRUE(panel.running());
  panel.signal(SIGINT);
  EXPECT_EQ(panel.exit_code(5s), 0) << panel.err();
  EXPECT_EQ(panel.out().find('\x1b'), std::string::npos) << "escape codes go to terminals only";
}

}  // namespace
}  // namespace bladefit::hil
