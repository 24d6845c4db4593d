// What the fit thread does with the events of a session.
#include "firmware_bridge/host/fit/fit_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

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
