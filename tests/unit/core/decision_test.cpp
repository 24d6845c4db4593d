#include "core/inspection/decision.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace bladefit {
namespace {

constexpr double kTolerance = 0.3;

JudgedDistance judged(double distance, double uncertainty, double expanded) {
  return {distance, kTolerance, uncertainty, expanded, 0.0};
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
  EXPECT_EQ(decide(DecisionRule::simple, {kTolerance + 1e-12, kTolerance, 0.0, 0.0, 1e-11}), PointState::in);
}

TEST(Decision, WithoutAToleranceEveryDistanceIsIn) {
  const JudgedDistance any{1e6, std::numeric_limits<double>::infinity(), 1e3, 1e3, 0.0};
  EXPECT_EQ(decide(DecisionRule::simple, any), PointState::in);
  EXPECT_EQ(decide(DecisionRule::guarded, any), PointState::in);
}

TEST(Decision, TheExpandedUncertaintyIsMadeOfPoseAndProbe) {
  const Decision decision{DecisionRule::guarded, 2.0, 0.003, 1e-5};
  EXPECT_DOUBLE_EQ(decision.expanded(0.0, 0.0), 0.006);
  EXPECT_DOUBLE_EQ(decision.expanded(0.003, 100.0), 2.0 * 0.005);
  EXPECT_DOUBLE_EQ(Decision{}.expanded(0.25, 1e6), 0.5) << "the probe's part is not known";
}

}  // namespace
}  // namespace bladefit
