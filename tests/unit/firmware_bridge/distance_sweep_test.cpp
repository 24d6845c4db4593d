// While points come in the distances of those before go on with the pose, and the feed follows them.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "firmware_bridge/host/fit/distance_sweep.hpp"
#include "firmware_bridge/host/fit/fit_stream.hpp"
#include "tests/support/owned_localizer.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using namespace std::chrono_literals;
using testing::blade;
using testing::measured_points;

TEST(DistanceSweep, GoesThroughAllPointsOnceForEachPoseInSlicesAtItsPace) {
  std::vector<std::uint32_t> stored(1000);
  std::iota(stored.begin(), stored.end(), 1U);
  DistanceSweep sweep;
  DistanceSweep::Clock::time_point now{1s};
  EXPECT_TRUE(sweep.next(stored, 0, now).empty()) << "no pose has moved";
  std::vector<std::uint32_t> told;
  for (; sweep.is_due(5); now += DistanceSweep::kPace) {
    const std::span<const std::uint32_t> slice = sweep.next(stored, 5, now);
    ASSERT_LE(slice.size(), DistanceSweep::kSlice);
    told.insert(told.end(), slice.begin(), slice.end());
    EXPECT_TRUE(sweep.next(stored, 5, now + 1ms).empty()) << "before its time";
  }
  EXPECT_EQ(told, stored);
  EXPECT_TRUE(sweep.next(stored, 5, now + 1h).empty());
  EXPECT_EQ(sweep.next(stored, 6, now + 1h).size(), DistanceSweep::kSlice);
}

TEST(DistanceSweep, EndsWherePointsHaveLostTheirPlaces) {
  const std::vector<std::uint32_t> stored(100);
  DistanceSweep sweep;
  EXPECT_EQ(sweep.next(stored, 1, DistanceSweep::Clock::time_point{1s}).size(), 64U);
  EXPECT_EQ(sweep.next({}, 1, DistanceSweep::Clock::time_point{2s}).size(), 0U);
  EXPECT_FALSE(sweep.is_due(1));
}

/// The distances that the fit knows once these points have come.
std::vector<double> known_distances(const std::vector<ProbePoint>& points, const HostSettings& settings) {
  testing::OwnedLocalizer owned(blade(), settings.localizer);
  FitStream stream(*owned, settings.path_refine_points);
  Verdict verdict;
  for (const ProbePoint& point : points) {
    EXPECT_TRUE(stream.push(point, verdict));
    stream.end_path();
  }
  std::vector<double> known;
  for (const ProbePoint& point : points) {
    EXPECT_EQ(owned->verdict_of(point.sequence, verdict), Status::ok);
    known.push_back(verdict.foot.distance);
  }
  return known;
}

/// How far the feed's distances are from these at the most [mm]; infinite while a point is missing.
double farthest(const PointFeed& feed, const std::vector<double>& known) {
  double most = 0;
  std::array<FedVerdict, 1> newest;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (feed.history(static_cast<std::uint32_t>(k) + 1, newest) == 0) return INFINITY;
    most = std::max(most, std::abs(static_cast<double>(newest[0].distance) - known[k]));
  }
  return most;
}

TEST(DistanceSweep, TheFeedHasEveryDistanceWhileTheSessionGoesOn) {
  const testing::ScratchFolder folder;
  constexpr std::size_t kCount = 600;
  testing::ScriptedSource source(measured_points(kCount + 1));
  source.stop_after = kCount;  // it falls silent: the session is neither finished nor at rest
  HostSettings settings = testing::settings_for(folder / "session");
  settings.feed = true;
  const std::vector<double> known = known_distances(measured_points(kCount), settings);
  Host host(settings, blade(), source, {});
  ASSERT_FALSE(host.start());
  constexpr double kUnseen = 0.2 / 64;  // of the looser tolerance
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (farthest(*host.feed(), known) > kUnseen && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(20ms);
  EXPECT_LE(farthest(*host.feed(), known), kUnseen);
  host.request_stop();
  EXPECT_TRUE(host.wait_for_end(10s));
}

}  // namespace
}  // namespace bladefit
