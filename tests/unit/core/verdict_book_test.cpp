// Judging points, counting the verdicts, and telling of those that have changed.

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/core/verdict_desk.hpp"

namespace bladefit::testing {
namespace {

using Numbers = std::vector<std::uint32_t>;

const Foot kGood = foot_at(kOnRest, 0.1), kHigh = foot_at(kOnRest, 0.3), kLow = foot_at(kOnRest, -0.3);

TEST(VerdictBook, CutsWhereThereIsTooMuchAndWeldsWhereThereIsTooLittle) {
  Desk desk(1);
  EXPECT_EQ(desk.state(kHigh), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::cut);
  EXPECT_EQ(desk.state(kLow), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::weld);
  EXPECT_EQ(desk.state(kGood), PointState::in);
  EXPECT_EQ(desk.store[0].action, Action::none);
}

TEST(VerdictBook, JudgesAPointByTheToleranceOfItsRegion) {
  Desk desk(1);
  EXPECT_EQ(desk.state(foot_at(kOnRest, 0.1)), PointState::in);
  EXPECT_EQ(desk.store[0].tolerance, kWide);
  EXPECT_EQ(desk.state(foot_at(kOnEdgeOfBlade, 0.1)), PointState::out);
  EXPECT_EQ(desk.store[0].tolerance, kTight);
  EXPECT_EQ(desk.store[0].region, Region::leading_edge);
}

TEST(VerdictBook, TakesADistanceThatTouchesItsToleranceForIn) {
  Desk desk(1);
  const double touching = tuning::kTouchingBound * desk.problem.frame.length;
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(desk.state(foot_at(kOnRest, sign * kWide)), PointState::in);
    EXPECT_EQ(desk.state(foot_at(kOnRest, sign * (kWide + 0.9 * touching))), PointState::in);
    EXPECT_EQ(desk.state(foot_at(kOnRest, sign * (kWide + 1.1 * touching))), PointState::out);
  }
}

TEST(VerdictBook, LeavesAVerdictPendingWhileWhatIsNotDeterminedMayChangeIt) {
  Desk desk(1);
  const double start = tuning::kStartUncertainty * desk.problem.frame.length;
  Vec6 open = Vec6::Zero();
  open[5] = 0.99 * tuning::kPendingShare * kWide / start;  // along the normal
  desk.know_pose(open);
  EXPECT_EQ(desk.state(kHigh), PointState::out);
  desk.know_pose(open * (1.01 / 0.99));
  EXPECT_EQ(desk.state(kHigh), PointState::pending);
  EXPECT_EQ(desk.store[0].action, Action::none);
  EXPECT_EQ(desk.state(foot_at(0.0, 0.3, FootKind::edge)), PointState::rejected) << "whatever is known of the pose";
}

TEST(VerdictBook, LeavesEveryVerdictPendingWhileThereAreTooFewPoints) {
  Desk desk(1);
  EXPECT_EQ(desk.state(kHigh, false), PointState::pending);
  EXPECT_EQ(desk.state(kHigh, true), PointState::out);
}

TEST(VerdictBook, RejectsAFootOnAnEdge) {
  Desk desk(1);
  EXPECT_EQ(desk.state(foot_at(0.0, 0.3, FootKind::edge)), PointState::rejected);
  EXPECT_EQ(desk.store[0].action, Action::none);
  EXPECT_EQ(desk.book.rejected(), 1U);
  EXPECT_EQ(desk.book.out(Region::rest), 0U);
}

TEST(VerdictBook, NeverFindsAPointOutWhereNoToleranceIsSet) {
  LocalizerConfig config = judged_config();
  config.tolerance.rest_mm = std::numeric_limits<double>::infinity();
  Desk desk(1, config);
  EXPECT_EQ(desk.state(foot_at(kOnRest, 50.0)), PointState::in);
  Vec6 open = Vec6::Zero();
  open[5] = 1.0;
  desk.know_pose(open);
  EXPECT_EQ(desk.state(foot_at(kOnRest, 50.0)), PointState::pending);
}

TEST(VerdictBook, CountsRightlyAfterEveryChange) {
  constexpr std::uint32_t kCount = 12;
  std::mt19937_64 random(17);
  Desk desk(kCount);
  for (int k = 0; k < 1000; ++k) {
    if (k == 500) desk.selection.hold(desk.store);
    const auto index = static_cast<std::uint32_t>(random() % kCount);
    const FootKind kind = random() % 4 == 0 ? FootKind::edge : FootKind::interior;
    desk.see(index, foot_at(random() % 2 == 0 ? kOnRest : kOnEdgeOfBlade, uniform(random, -0.3, 0.3), kind));
    if (random() % 4 == 0) {
      desk.book.assign_region(desk.store[index]);
    } else {
      desk.book.judge_again(desk.store, index, desk.evidence(random() % 5 != 0));
    }
    std::array<std::uint32_t, 2> out{};
    std::uint32_t rejected = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      if (desk.store[i].state == PointState::out) ++out[static_cast<std::size_t>(desk.store[i].region)];
      if (desk.store[i].state == PointState::rejected) ++rejected;
    }
    ASSERT_EQ(desk.book.out(Region::rest), out[0]) << "step " << k;
    ASSERT_EQ(desk.book.out(Region::leading_edge), out[1]) << "step " << k;
    ASSERT_EQ(desk.book.rejected(), rejected) << "step " << k;
  }
}

TEST(VerdictBook, KeepsHeldRegionsUntilTheyAreAssignedAgain) {
  Desk desk(1);
  desk.judge(0, foot_at(kOnEdgeOfBlade, 0.1));
  desk.selection.hold(desk.store);
  desk.judge(0, kGood);
  EXPECT_EQ(desk.store[0].region, Region::leading_edge);
  EXPECT_EQ(desk.book.out(Region::leading_edge), 1U);
  desk.book.assign_region(desk.store[0]);
  EXPECT_EQ(desk.store[0].region, Region::rest);
  EXPECT_EQ(desk.store[0].tolerance, kWide);
  EXPECT_EQ(desk.book.out(Region::rest), 1U) << "counted where it belongs until it is judged";
  desk.judge(0, kGood);
  EXPECT_EQ(desk.book.out(Region::rest), 0U);
}

TEST(VerdictBook, TellsOfAChangeOnceAndAsItIsThen) {
  Desk desk(2);
  Verdict verdict;
  EXPECT_FALSE(desk.book.next_revision(desk.store, verdict)) << "what is new is told at once";
  desk.judge(1, kHigh);
  desk.judge(1, kLow);
  EXPECT_TRUE(desk.store[1].queued);
  ASSERT_TRUE(desk.book.next_revision(desk.store, verdict));
  EXPECT_FALSE(desk.store[1].queued);
  EXPECT_EQ(verdict.sequence, 2U);
  EXPECT_EQ(verdict.state, PointState::out);
  EXPECT_EQ(verdict.action, Action::weld);
  EXPECT_FALSE(desk.book.next_revision(desk.store, verdict));
  desk.judge(1, kLow);
  EXPECT_FALSE(desk.book.next_revision(desk.store, verdict)) << "it has not changed since it was told";
  desk.judge(1, kHigh);
  EXPECT_EQ(desk.told(), Numbers{2}) << "another action, the same state";
}

TEST(VerdictBook, DoesNotTellOfAChangeBack) {
  Desk desk(2);
  desk.judge(0, kHigh);
  desk.judge(1, kHigh);
  desk.judge(0, kGood);
  EXPECT_EQ(desk.told(), Numbers{2});
  desk.judge(0, kHigh);
  EXPECT_EQ(desk.told(), Numbers{1}) << "and can tell of the next one";
}

TEST(VerdictBook, TellsOfChangesInTheirOrderRoundTheEndOfItsMemory) {
  Desk desk(3);
  bool high = false;
  for (int k = 0; k < 10; ++k) {
    high = !high;
    const Foot& foot = high ? kHigh : kGood;
    Verdict verdict;
    desk.judge(0, foot);
    desk.judge(1, foot);
    ASSERT_TRUE(desk.book.next_revision(desk.store, verdict));
    EXPECT_EQ(verdict.sequence, 1U);
    desk.judge(2, foot);
    desk.judge(0, high ? kLow : kHigh);  // the ring is full
    ASSERT_EQ(desk.told(), (Numbers{2, 3, 1})) << k;
    desk.judge(0, foot);
    ASSERT_EQ(desk.told(), Numbers{1}) << k;
  }
}

TEST(VerdictBook, ForgetsCountsAndChangesWhenCleared) {
  Desk desk(2);
  desk.judge(0, kHigh);
  desk.judge(1, foot_at(0.0, 0.0, FootKind::edge));
  desk.book.clear();
  EXPECT_EQ(desk.told(), Numbers{});
  EXPECT_EQ(desk.book.out(Region::rest), 0U);
  EXPECT_EQ(desk.book.rejected(), 0U);
}

TEST(VerdictBook, GivesAVerdictAllThatIsKnownOfThePoint) {
  Desk desk(1);
  desk.store[0].revision = 41;
  desk.judge(0, foot_at(kOnEdgeOfBlade, 0.3));
  const Verdict verdict = verdict_of(desk.store[0]);
  EXPECT_EQ(verdict.sequence, 1U);
  EXPECT_EQ(verdict.foot.distance, 0.3);
  EXPECT_EQ(verdict.region, Region::leading_edge);
  EXPECT_EQ(verdict.tolerance_mm, kTight);
  EXPECT_EQ(verdict.uncertainty_mm, desk.estimate.uncertainty_of(desk.store[0].position, desk.store[0].foot).standard);
  EXPECT_EQ(verdict.state, PointState::out);
  EXPECT_EQ(verdict.action, Action::cut);
  EXPECT_EQ(verdict.revision, 41U);
}

}  // namespace
}  // namespace bladefit::testing
