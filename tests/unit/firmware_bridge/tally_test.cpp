// Verdicts in, counts out: against counting everything again.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "firmware_bridge/host/panel/tally.hpp"

namespace bladefit {
namespace {

Verdict verdict(std::uint32_t sequence, PointState state, Region region = Region::leading_edge) {
  Verdict made;
  made.sequence = sequence;
  made.state = state;
  made.region = region;
  return made;
}

/// One zone that holds every foot of patch 0, and tolerances everywhere.
ToleranceMap all_judged() {
  ToleranceMap map;
  map.box_count = 1;
  map.leading_edge_mm = map.rest_mm = 0.1;
  return map;
}

std::uint32_t zone_points(const Tally& tally) {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(tally.verdicts(), [](const auto& entry) { return is_judged(entry.second.state); }));
}

TallyCounts counted_anew(const Tally& tally) {
  TallyCounts counts;
  for (const auto& [sequence, verdict] : tally.verdicts()) {
    ++counts.points;
    if (verdict.state == PointState::rejected) {
      ++counts.rejected;
      continue;
    }
    if (verdict.state == PointState::pending) ++counts.pending;
    if (verdict.state == PointState::undecided) ++counts.undecided;
    const bool out = verdict.state == PointState::out;
    if (verdict.region == Region::leading_edge) {
      ++counts.leading_edge;
      if (out) ++counts.leading_edge_out;
    } else if (out) {
      ++counts.rest_out;
    }
  }
  return counts;
}

std::vector<std::uint32_t> newest_out(const Tally& tally) {
  std::vector<std::uint32_t> sequences;
  for (const Verdict& verdict : tally.newest_leading_edge_out()) sequences.push_back(verdict.sequence);
  return sequences;
}

/// The distance of largest magnitude, by looking at them all.
double farthest(const Tally& tally, Region region) {
  double distance = 0;
  for (const auto& [sequence, verdict] : tally.verdicts()) {
    const bool judged = verdict.region == region && verdict.state != PointState::rejected;
    if (judged && verdict.state != PointState::pending) distance = std::max(distance, verdict.foot.distance);
  }
  return distance;
}

TEST(BridgeTally, CountsAgreeWithCountingAnewForAnyRevisions) {
  std::mt19937 random(20240511);
  const ToleranceMap judged_everywhere = all_judged();
  const BladeLayout nowhere;
  Tally tally(judged_everywhere, nowhere);
  for (int step = 0; step < 3000; ++step) {
    tally.accept(verdict(1 + static_cast<std::uint32_t>(random() % 200), static_cast<PointState>(random() % 5),
                         static_cast<Region>(random() % 2)));
    const TallyCounts expected = counted_anew(tally);
    const TallyCounts& counts = tally.counts();
    ASSERT_EQ(counts.points, expected.points);
    ASSERT_EQ(counts.leading_edge, expected.leading_edge);
    ASSERT_EQ(counts.leading_edge_out, expected.leading_edge_out);
    ASSERT_EQ(counts.rest_out, expected.rest_out);
    ASSERT_EQ(counts.rejected, expected.rejected);
    ASSERT_EQ(counts.pending, expected.pending);
    ASSERT_EQ(counts.undecided, expected.undecided);
    ASSERT_EQ(tally.zones().points(0), zone_points(tally));
    ASSERT_EQ(tally.newest_leading_edge_out().size(), std::min<std::size_t>(expected.leading_edge_out, Tally::kNewest));
  }
}

TEST(BridgeTally, TheWorstPointIsAJudgedOneUnlessPendingOnesAreAskedFor) {
  const ToleranceMap judged_everywhere = all_judged();
  const BladeLayout nowhere;
  Tally tally(judged_everywhere, nowhere);
  EXPECT_EQ(tally.worst(Region::leading_edge, true), nullptr);
  Verdict near = verdict(1, PointState::in), far = verdict(2, PointState::out),
          farther = verdict(3, PointState::pending);
  near.foot.distance = 0.01;
  far.foot.distance = -0.4;
  farther.foot.distance = 5.0;
  for (const Verdict& v : {near, far, farther}) tally.accept(v);
  EXPECT_EQ(tally.worst(Region::leading_edge, false)->sequence, 2U);
  EXPECT_EQ(tally.worst(Region::leading_edge, true)->sequence, 3U);
  EXPECT_EQ(tally.worst(Region::rest, true), nullptr);
}

TEST(BridgeTally, TheWorstPointIsFoundAgainWhenItComesNearer) {
  std::mt19937 random(77);
  const ToleranceMap judged_everywhere = all_judged();
  const BladeLayout nowhere;
  Tally tally(judged_everywhere, nowhere);
  for (int step = 0; step < 2000; ++step) {
    Verdict made = verdict(1 + static_cast<std::uint32_t>(random() % 50), static_cast<PointState>(random() % 5),
                           static_cast<Region>(random() % 2));
    made.foot.distance = static_cast<double>(random() % 1000);
    tally.accept(made);
    for (const Region region : {Region::rest, Region::leading_edge}) {
      const Verdict* const worst = tally.worst(region, false);
      ASSERT_EQ(worst != nullptr ? worst->foot.distance : 0, farthest(tally, region)) << step;
    }
  }
}

TEST(BridgeTally, APointThatIsGivenUpStaysInEveryFigure) {
  const ToleranceMap judged_everywhere = all_judged();
  const BladeLayout nowhere;
  Tally tally(judged_everywhere, nowhere);
  Verdict far = verdict(1, PointState::out), near = verdict(2, PointState::out);
  far.foot.distance = -3.0;
  near.foot.distance = 1.0;
  tally.accept(far);
  tally.accept(near);
  tally.give_up(1);
  tally.give_up(99);
  EXPECT_EQ(tally.find(1), nullptr);
  EXPECT_EQ(tally.counts().leading_edge_out, 2U);
  near.foot.distance = 0.5;
  tally.accept(near);
  EXPECT_EQ(tally.worst(Region::leading_edge, false)->sequence, 1U);
  EXPECT_EQ(newest_out(tally), (std::vector<std::uint32_t>{2, 1}));
}

TEST(BridgeTally, ListsTheLeadingEdgePointThatBecameOutLastFirst) {
  const ToleranceMap judged_everywhere = all_judged();
  const BladeLayout nowhere;
  Tally tally(judged_everywhere, nowhere);
  for (const std::uint32_t sequence : {1U, 2U, 3U, 4U}) tally.accept(verdict(sequence, PointState::in));
  tally.accept(verdict(4, PointState::out));
  tally.accept(verdict(2, PointState::out));
  tally.accept(verdict(3, PointState::out, Region::rest));
  tally.accept(verdict(4, PointState::out));  // told again: keeps its place
  EXPECT_EQ(newest_out(tally), (std::vector<std::uint32_t>{2, 4}));
  EXPECT_EQ(tally.times_out(), 3U);
  tally.accept(verdict(4, PointState::in));
  EXPECT_EQ(newest_out(tally), std::vector<std::uint32_t>{2});
  tally.clear();
  EXPECT_EQ(tally.counts().points, 0U);
  EXPECT_EQ(tally.find(2), nullptr);
}

}  // namespace
}  // namespace bladefit
