// What befalls a session from outside: losses, other settings, a journal that is removed, a full memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "core/fit/pose.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using namespace std::chrono_literals;
using testing::blade;
using testing::measured_points;
using testing::ScratchFolder;
using testing::ScriptedSource;
using testing::settings_for;

testing::WholeResult result_of_session(const HostSettings& settings, ProbeSource& source) {
  Host host(settings, blade(), source, {});
  if (const Failure error = host.start()) {
    testing::WholeResult failed;
    failed.error = error;
    return failed;
  }
  EXPECT_TRUE(host.wait_for_end(60s));
  return testing::finish_whole(host);
}

TEST(HostFaults, ALossThatWasToldIsStoredAndAcknowledged) {
  const ScratchFolder folder;
  HostSettings settings = settings_for(folder / "session");
  settings.end_when_finished = false;
  settings.idle = 200ms;
  ScriptedSource source(measured_points(20));
  source.last = 28;
  const testing::WholeResult result = result_of_session(settings, source);
  EXPECT_EQ(source.acknowledged, 28U);
  ASSERT_EQ(result.lost.size(), 1U);
  EXPECT_EQ(result.lost[0].first, 21U);
  EXPECT_EQ(result.lost[0].last, 28U);
  ScriptedSource again(measured_points(20));
  EXPECT_EQ(result_of_session(settings, again).losses.records(), 8U);
  EXPECT_EQ(again.opened_after, 28U);
}

TEST(HostFaults, ASourceThatCannotGoOnEndsTheSessionWithWhatIsStored) {
  const ScratchFolder folder;
  ScriptedSource source(measured_points(50));
  source.stop_after = 20;
  source.stopped = "the numbers begin again";
  const testing::WholeResult result = result_of_session(settings_for(folder / "session"), source);
  EXPECT_EQ(result.error.kind, Failure::Kind::device);
  EXPECT_EQ(result.error.message, source.stopped);
  EXPECT_EQ(result.points.size(), 20U);
}

TEST(HostFaults, ASessionWhoseFolderIsRemovedEndsAndGivesItsResult) {
  const ScratchFolder folder;
  ScriptedSource source(measured_points(50));
  source.stop_after = 20;
  Host host(settings_for(folder / "session"), blade(), source, {});
  ASSERT_FALSE(host.start());
  EXPECT_FALSE(host.wait_for_end(300ms));
  std::filesystem::remove_all(folder / "session");
  ASSERT_TRUE(host.wait_for_end(10s));
  const testing::WholeResult result = testing::finish_whole(host);
  EXPECT_EQ(result.error.kind, Failure::Kind::device);
  EXPECT_NE(result.error.message.find("was removed during the session"), std::string::npos) << result.error.message;
  EXPECT_EQ(result.verdicts.size(), 20U);
}

TEST(HostFaults, OtherSettingsAreNamedWithBothValues) {
  const ScratchFolder folder;
  const HostSettings settings = settings_for(folder / "session");
  ScriptedSource source(measured_points(50));
  ASSERT_FALSE(result_of_session(settings, source).error);
  HostSettings other = settings;
  other.localizer.tolerance.leading_edge_mm = 0.11;
  other.localizer.mode = FitMode::minimax;
  ScriptedSource again(measured_points(50));
  const std::string message = result_of_session(other, again).error.message;
  EXPECT_NE(
      message.find("tolerance.leading_edge_mm was 0.1 and is 0.11, mode was least_squares and is minimax; repeat"),
      std::string::npos)
      << message;
  std::filesystem::remove(folder / "session/settings.txt");
  const std::string plain = result_of_session(other, again).error.message;
  EXPECT_NE(plain.find("begun with other fit settings; repeat those"), std::string::npos) << plain;
}

/// Each foot is that of the point at the final pose: its distance from the point is the distance told.
TEST(HostFaults, WithAFullMemoryEveryPointIsJudgedAtTheFinalPose) {
  const ScratchFolder folder;
  HostSettings settings = settings_for(folder / "session");
  settings.localizer.capacity = 64;
  ScriptedSource source(measured_points(400));
  const testing::WholeResult result = result_of_session(settings, source);
  ASSERT_FALSE(result.error) << result.error.message;
  EXPECT_TRUE(result.report.memory_full);
  ASSERT_EQ(result.verdicts.size(), 400U);
  for (std::size_t k = 0; k < result.verdicts.size(); ++k) {
    const Verdict& verdict = result.verdicts[k];
    EXPECT_EQ(verdict.sequence, result.points[k].sequence);
    if (verdict.state == PointState::rejected) continue;
    const Vec3 at = apply(result.report.pose, Vec3(result.points[k].position.data()));
    EXPECT_NEAR((at - verdict.foot.point).norm(), std::abs(verdict.foot.distance), 1e-7) << verdict.sequence;
  }
}

TEST(HostFaults, WithAFullMemoryThePanelEndsWithTheCountsOfTheResult) {
  const ScratchFolder folder;
  HostSettings settings = settings_for(folder / "session");
  settings.localizer.capacity = 64;
  settings.localizer.tolerance.leading_edge_mm = 0.03;
  ScriptedSource source(measured_points(400));
  Host host(settings, blade(), source, {});
  ASSERT_FALSE(host.start());
  ASSERT_TRUE(host.wait_for_end(60s));
  const testing::WholeResult result = testing::finish_whole(host);
  const auto out = static_cast<std::uint32_t>(std::ranges::count_if(result.verdicts, [](const Verdict& verdict) {
    return verdict.state == PointState::out && verdict.region == Region::leading_edge;
  }));
  EXPECT_GT(out, 0U);
  BladeVerdict verdict;
  verdict.reasons.add(Reason::ambiguous);
  host.conclude({verdict});
  const auto until = std::chrono::steady_clock::now() + 10s;
  while ((host.panel_state().reasons & kReasonAmbiguous) == 0 && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(5ms);
  EXPECT_EQ(host.panel_state().leading_edge_out, out);
  EXPECT_EQ(host.panel_state().points, 400U);
}

}  // namespace
}  // namespace bladefit
