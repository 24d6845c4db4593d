// What the fit thread does with the events of a session.
#include "firmware_bridge/host/fit/fit_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "firmware_bridge/host/fit/recent_alarms.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using testing::blade;
using testing::blade_config;
using testing::measured_points;

TEST(BridgeFitStream, ResetForgetsEverythingAndAReplayGivesTheSameBits) {
  const LocalizerConfig config = blade_config();
  std::vector<std::byte> memory(Localizer::memory_required(config) + 64);
  void* start = memory.data();
  std::size_t space = memory.size();
  std::align(64, Localizer::memory_required(config), start, space);
  Localizer* localizer = nullptr;
  ASSERT_EQ(Localizer::create({static_cast<std::byte*>(start), space}, blade(), config, localizer), Status::ok);
  FitStream stream(*localizer, 2048);
  const auto feed = [&stream] {
    Verdict verdict;
    for (const ProbePoint& point : measured_points(100)) {
      EXPECT_TRUE(stream.push(point, verdict));
      stream.end_path();
    }
    EXPECT_FALSE(stream.push(measured_points(100).back(), verdict)) << "a number that came before";
    stream.settle();
  };
  feed();
  const FitReport first = localizer->fit();
  stream.reset();
  EXPECT_EQ(localizer->fit().points, 0U);
  feed();
  EXPECT_EQ(std::bit_cast<std::uint64_t>(localizer->fit().rms_mm), std::bit_cast<std::uint64_t>(first.rms_mm));
  std::vector<StreamEvent> events = {{EventKind::finished, {}}, {EventKind::reset, {}}};
  for (const ProbePoint& point : measured_points(100)) events.push_back({EventKind::point, point});
  const bool given = stream.replay([&events](const auto& take) {
    std::ranges::for_each(events, take);
    return true;
  });
  EXPECT_TRUE(given);
  EXPECT_EQ(localizer->fit().points, 100U);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(localizer->fit().rms_mm), std::bit_cast<std::uint64_t>(first.rms_mm));
}

TEST(LocalizerPlaces, APointThatLostItsPlaceIsJudgedAsideAndChangesNothing) {
  LocalizerConfig config = blade_config();
  config.capacity = 64;
  std::vector<std::byte> memory(Localizer::memory_required(config) + 64);
  void* start = memory.data();
  std::size_t space = memory.size();
  std::align(64, Localizer::memory_required(config), start, space);
  Localizer* localizer = nullptr;
  ASSERT_EQ(Localizer::create({static_cast<std::byte*>(start), space}, blade(), config, localizer), Status::ok);
  const std::vector<ProbePoint> points = measured_points(400);
  std::uint32_t displaced = 0;
  Verdict verdict;
  for (const ProbePoint& point : points) {
    ASSERT_TRUE(succeeded(localizer->push(point, verdict)));
    if (localizer->displaced() != 0) displaced = localizer->displaced();
  }
  ASSERT_GT(displaced, 0U);
  EXPECT_EQ(localizer->verdict_of(displaced, verdict), Status::not_found);
  const FitReport before = localizer->fit();
  ASSERT_EQ(localizer->judge_aside(points[displaced - 1], verdict), Status::ok);
  EXPECT_EQ(verdict.sequence, displaced);
  EXPECT_TRUE(has_foot(verdict));
  EXPECT_EQ(verdict.revision, before.revision);
  EXPECT_EQ(localizer->fit().rest.judged_out, before.rest.judged_out);
  EXPECT_EQ(localizer->fit().rejected, before.rejected);
  EXPECT_EQ(localizer->fit().points, before.points);
  ProbePoint none = points[0];
  none.position[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(localizer->judge_aside(none, verdict), Status::not_finite);
}

TEST(BridgeRecentAlarms, KeepTheNewestLeadingEdgePointsThatAreOut) {
  RecentAlarms alarms;
  const auto note = [&alarms](std::uint32_t sequence, PointState state, Region region) {
    Verdict verdict;
    verdict.sequence = sequence;
    verdict.state = state;
    verdict.region = region;
    alarms.note(verdict);
  };
  note(1, PointState::in, Region::leading_edge);
  note(2, PointState::out, Region::rest);
  EXPECT_EQ(std::ranges::count(alarms.sequences(), 0U), std::ptrdiff_t{RecentAlarms::kMost});
  for (std::uint32_t sequence = 3; sequence < 3 + RecentAlarms::kMost; ++sequence) {
    note(sequence, PointState::out, Region::leading_edge);
  }
  note(3, PointState::out, Region::leading_edge);
  EXPECT_EQ(std::ranges::count(alarms.sequences(), 3U), 1) << "it is there already";
  note(100, PointState::out, Region::leading_edge);
  EXPECT_EQ(std::ranges::count(alarms.sequences(), 3U), 0) << "the oldest makes room";
  EXPECT_EQ(std::ranges::count(alarms.sequences(), 100U), 1);
  alarms.clear();
  EXPECT_EQ(std::ranges::count(alarms.sequences(), 0U), std::ptrdiff_t{RecentAlarms::kMost});
}

}  // namespace
}  // namespace bladefit
