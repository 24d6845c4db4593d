// What the panel of a running host shows, read over a real socket.
#include <gtest/gtest.h>
#include <modbus.h>

#include "tests/unit/firmware_bridge/fixtures.hpp"
#include "tools/panel/panel_client.hpp"

namespace bladefit {
namespace {

using namespace std::chrono_literals;
using testing::blade;
using testing::measured_points;
using testing::ScratchFolder;
using testing::ScriptedSource;
using testing::settings_for;

constexpr std::size_t kSessionPoints = 400;
constexpr int kAcknowledgeCoil = 3;

/// A session that goes on until it is told to stop, and what its panel shows.
class WatchedSession {
 public:
  explicit WatchedSession(ScriptedSource& source) : host_(endless(folder_ / "session"), blade(), source, {}) {
    EXPECT_FALSE(host_.start());
  }

  /// Reads the panel until `wanted` holds.
  template <typename Condition>
  [[nodiscard]] bool shows(Condition wanted) {
    PanelClient client("127.0.0.1", host_.panel_port());
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < deadline) {
      if (!client.read(panel) && wanted(panel)) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  }

  /// Presses the coil that acknowledges the alarms.
  void acknowledge_alarms() const {
    modbus_t* const line = modbus_new_tcp("127.0.0.1", host_.panel_port());
    EXPECT_EQ(modbus_connect(line), 0);
    EXPECT_EQ(modbus_write_bit(line, kAcknowledgeCoil, 1), 1);
    modbus_close(line);
    modbus_free(line);
  }

  testing::WholeResult stop() {
    host_.request_stop();
    EXPECT_TRUE(host_.wait_for_end(10s));
    return testing::finish_whole(host_);
  }

  void conclude(const Conclusion& conclusion) { host_.conclude(conclusion); }

  /// What the session's own screen gets.
  [[nodiscard]] PanelState own() const { return host_.panel_state(); }

  PanelState panel;

 private:
  static HostSettings endless(const std::string& folder) {
    HostSettings settings = settings_for(folder);
    settings.end_when_finished = false;
    settings.panel.commands = true;
    return settings;
  }

  ScratchFolder folder_;
  Host host_;
};

TEST(SessionPanel, ShowsAFaultOfTheDevice) {
  ScriptedSource source(measured_points(kSessionPoints));
  source.device_fault = true;
  WatchedSession session(source);
  EXPECT_TRUE(session.shows(
      [](const PanelState& shown) { return shown.points == kSessionPoints && shown.session == SessionState::fault; }));
  EXPECT_FALSE(session.stop().error);
}

TEST(SessionPanel, ALossAfterTheAcknowledgedOneRaisesTheAlarmAgain) {
  ScriptedSource source(measured_points(50));
  source.losses = 1;
  WatchedSession session(source);
  const auto alarmed = [](const PanelState& shown) { return (shown.alarms & kAlarmDataGap) != 0; };
  ASSERT_TRUE(session.shows(alarmed));
  session.acknowledge_alarms();
  ASSERT_TRUE(session.shows([&](const PanelState& shown) { return !alarmed(shown); }));
  source.losses = 2;
  EXPECT_TRUE(session.shows(alarmed));
  EXPECT_FALSE(session.stop().error);
}

TEST(SessionPanel, EndsWithTheVerdictOfTheWholeResult) {
  ScriptedSource source(measured_points(kSessionPoints));
  WatchedSession session(source);
  ASSERT_TRUE(session.shows([](const PanelState& shown) { return shown.points == kSessionPoints; }));
  EXPECT_FALSE(session.stop().error);
  BladeVerdict verdict;
  verdict.reasons.add(Reason::ambiguous);
  session.conclude({.verdict = verdict, .otherwise_count = 9, .otherwise = {12, 13}});
  EXPECT_TRUE(session.shows([](const PanelState& shown) {
    return shown.verdict == BladeState::not_decided && shown.reasons == (kReasonAmbiguous | kReasonOtherwise);
  }));
  EXPECT_EQ(session.panel.otherwise_count, 9U);
  EXPECT_EQ(session.panel.otherwise[1], 13U);
  EXPECT_EQ(session.own().reasons, session.panel.reasons) << "the session's own screen shows the same";
}

TEST(SessionPanel, StaysWithTheResultOfAnEndedSession) {
  ScriptedSource source(measured_points(kSessionPoints));
  WatchedSession session(source);
  ASSERT_TRUE(session.shows([](const PanelState& shown) { return shown.points == kSessionPoints && !shown.ended; }));
  const testing::WholeResult result = session.stop();
  session.conclude({{BladeState::in_tolerance, {}}});
  ASSERT_TRUE(session.shows([](const PanelState& shown) { return shown.ended; }));
  EXPECT_EQ(session.panel.verdict, BladeState::in_tolerance);
  EXPECT_EQ(session.panel.points, result.points.size());
  EXPECT_EQ(session.panel.rms, static_cast<float>(result.report.rms_mm));
  EXPECT_EQ(session.panel.leading_edge_out, result.report.leading_edge.judged_out);
}

TEST(SessionPanel, ShowsTheSession) {
  ScriptedSource source(measured_points(kSessionPoints));
  WatchedSession session(source);
  ASSERT_TRUE(session.shows([](const PanelState& shown) {
    return shown.points == kSessionPoints && shown.session == SessionState::settled;
  }));
  const testing::WholeResult result = session.stop();
  const PanelState& state = session.panel;
  EXPECT_EQ(state.leading_edge_out, result.report.leading_edge.judged_out);
  EXPECT_EQ(state.rest_out, result.report.rest.judged_out);
  EXPECT_EQ(state.rms, static_cast<float>(result.report.rms_mm));
  EXPECT_EQ(state.worst_leading_edge_sequence, result.report.leading_edge.worst_sequence);
  EXPECT_EQ(state.last_sequence, kSessionPoints);
  EXPECT_EQ(state.determined, 6);
  EXPECT_GT(state.push_latency_us, 0.0F);
  for (const PanelPlace& place : state.newest) {
    if (place.sequence == 0) continue;
    const Verdict& verdict = result.verdicts.at(place.sequence - 1);
    EXPECT_EQ(verdict.state, PointState::out);
    EXPECT_EQ(place.distance, static_cast<float>(verdict.foot.distance));
    EXPECT_EQ(place.action, verdict.action);
    EXPECT_GT(place.radius, 20.0F);
  }
}

}  // namespace
}  // namespace bladefit
