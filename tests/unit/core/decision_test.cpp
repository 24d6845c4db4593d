#include "core/inspection/decision.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace bladefit {
namespace {

constexpr double kTolerance = 0.3;

JudgedDistance judged(double distance, double uncertainty, double expanded) {
  return {distance, Limits::both(kTolerance), uncertainty, expanded, 0.0};
}

TEST(Decision, SimpleComparesTheDistanceAsItIs) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(decide(DecisionRule::simple, judged(sign * 0.299, 0.01, 0.02)), PointState::in);
    EXPECT_EQ(decide(DecisionRule::simple, judged(sign * 0.301, 0.01, 0.02)), PointState::out);
  }
}

TEST(Decision, SimpleWaitsWhereTheUncertaintyReachesAThirdOfTheTolerance) {
  EXPECT_EQ(decide(DecisionRule::simple, judged(0.0, 0.099, 0.198)), PointState::in);
  EXPECT_EQ(decide(DecisionRule::simple, judged(0.0, 0.101, 0.202)), PointState::pending);
  EXPECT_EQ(decide(DecisionRule::simple, judged(0.4, 0.101, 0.202)), PointState::pending);
  EXPECT_EQ(decide(DecisionRule::simple, judged(0.6, 0.101, 0.202)), PointState::out) << "beyond any doubt";
}

TEST(Decision, GuardedIsInOrOutOnlyBeyondTheExpandedUncertainty) {
  const auto state = [](double distance) { return decide(DecisionRule::guarded, judged(distance, 0.01, 0.02)); };
  EXPECT_EQ(state(0.279), PointState::in);
  EXPECT_EQ(state(0.281), PointState::undecided);
  EXPECT_EQ(state(-0.319), PointState::undecided);
  EXPECT_EQ(state(-0.321), PointState::out);
}

TEST(Decision, ADistanceThatTouchesItsBoundIsIn) {
  EXPECT_EQ(decide(DecisionRule::simple, {kTolerance + 1e-12, Limits::both(kTolerance), 0.0, 0.0, 1e-11}),
            PointState::in);
}

TEST(Decision, WithoutAToleranceEveryDistanceIsIn) {
  const JudgedDistance any{1e6, Limits::both(std::numeric_limits<double>::infinity()), 1e3, 1e3, 0.0};
  EXPECT_EQ(decide(DecisionRule::simple, any), PointState::in);
  EXPECT_EQ(decide(DecisionRule::guarded, any), PointState::in);
}

constexpr Limits kOneSided{0.1, 0.05};  ///< more is allowed above than below

PointState state_of(DecisionRule rule, double distance, double uncertainty, double expanded) {
  return decide(rule, {distance, kOneSided, uncertainty, expanded, 0.0});
}

TEST(Decision, EachSideHasItsOwnLimit) {
  const auto state = [](double distance) { return state_of(DecisionRule::simple, distance, 0.001, 0.002); };
  EXPECT_EQ(state(0.08), PointState::in);
  EXPECT_EQ(state(-0.08), PointState::out);
  EXPECT_EQ(state(0.101), PointState::out);
  EXPECT_EQ(state(-0.049), PointState::in);
  EXPECT_EQ(state(-0.051), PointState::out);
}

TEST(Decision, GuardedNeedsBothLimitsToBeClear) {
  const auto state = [](double distance) { return state_of(DecisionRule::guarded, distance, 0.01, 0.02); };
  EXPECT_EQ(state(0.08), PointState::in);
  EXPECT_EQ(state(0.081), PointState::undecided);
  EXPECT_EQ(state(0.121), PointState::out);
  EXPECT_EQ(state(-0.03), PointState::in);
  EXPECT_EQ(state(-0.031), PointState::undecided);
  EXPECT_EQ(state(-0.069), PointState::undecided);
  EXPECT_EQ(state(-0.071), PointState::out);
  EXPECT_EQ(state_of(DecisionRule::guarded, 0.01, 0.035, 0.07), PointState::undecided)
      << "above the design, but the limit below it is within the uncertainty";
}

TEST(Decision, WhatIsLittleKnownIsPendingByTheNearerLimit) {
  EXPECT_EQ(state_of(DecisionRule::simple, 0.08, 0.016, 0.032), PointState::in);
  EXPECT_EQ(state_of(DecisionRule::simple, 0.08, 0.017, 0.034), PointState::pending) << "a third of 0.05";
}

TEST(Decision, ASideWithoutALimitIsNotJudged) {
  const JudgedDistance above{1e6, {std::numeric_limits<double>::infinity(), 0.05}, 0.001, 0.002, 0.0};
  EXPECT_EQ(decide(DecisionRule::simple, above), PointState::in);
  EXPECT_EQ(decide(DecisionRule::guarded, above), PointState::in);
  JudgedDistance below = above;
  below.distance = -0.06;
  EXPECT_EQ(decide(DecisionRule::simple, below), PointState::out);
}

TEST(Decision, TheExpandedUncertaintyIsMadeOfPoseAndProbe) {
  const Decision decision{DecisionRule::guarded, 2.0, 0.003, 1e-5};
  EXPECT_DOUBLE_EQ(decision.expanded(0.0, 0.0), 0.006);
  EXPECT_DOUBLE_EQ(decision.expanded(0.003, 100.0), 2.0 * 0.005);
  EXPECT_DOUBLE_EQ(Decision{}.expanded(0.25, 1e6), 0.5) << "the probe's part is not known";
}

}  // namespace
}  // namespace bladefit
