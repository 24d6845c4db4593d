// Whether points are judged whose feet lie on edges, joints or outside of the window, and by what.

#include <gtest/gtest.h>

#include "tests/unit/core/verdict_desk.hpp"

namespace bladefit::testing {
namespace {

const Foot kWithin = foot_at(kOnRest, 0.1), kAbove = foot_at(kOnRest, 0.3), kBelow = foot_at(kOnRest, -0.3);

Foot beyond_edge(double u, double distance, double beyond, FootBorder border = FootBorder::outer) {
  Foot foot = foot_at(u, distance, border == FootBorder::outer ? FootKind::edge : FootKind::corner);
  foot.border = border;
  foot.beyond = beyond;
  return foot;
}

TEST(VerdictAtEdge, JudgesAFootOnAJointLikeAnyOther) {
  Desk desk(1);
  for (const double distance : {0.3, -0.3, 0.1}) {
    Foot foot = foot_at(kOnRest, distance, FootKind::edge);
    foot.border = FootBorder::joint;
    EXPECT_EQ(desk.state(foot), std::abs(distance) > kWide ? PointState::out : PointState::in);
    EXPECT_EQ(desk.store[0].action, distance > kWide ? Action::cut : distance < -kWide ? Action::weld : Action::none);
    EXPECT_FALSE(verdict_of(desk.store[0]).fitted) << "being judged is one thing, to count in the fit another";
  }
}

TEST(VerdictAtEdge, FindsWhatLiesBeyondAnOuterEdgeOutWithNothingToDo) {
  Desk desk(1);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.3, 0.21)), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::none);
  EXPECT_EQ(desk.store[0].left_out, LeftOut::none);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.3, 0.19)), PointState::rejected);
  EXPECT_EQ(desk.store[0].left_out, LeftOut::edge);
  EXPECT_EQ(desk.state(beyond_edge(kOnEdgeOfBlade, 0.3, 0.19)), PointState::out) << "the tolerance there counts";
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 5.0, 0.1)), PointState::rejected) << "across a blunt edge";
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.3, 0.21), false), PointState::pending);
}

/// So far from it that it need not be the end of the blade that was probed.
TEST(VerdictAtEdge, LeavesOpenWhatLiesFarBeyondAnOuterEdge) {
  Desk desk(1);
  const double far = tuning::kFarBeyond * desk.problem.frame.length;
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 1.1 * far, 1.01 * far)), PointState::undecided);
  EXPECT_EQ(desk.store[0].action, Action::none);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 1.1 * far, 0.99 * far)), PointState::out);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 1.1 * far, 1.01 * far), false), PointState::pending);
}

TEST(VerdictAtEdge, DoesNotFindAPointBeyondAnEdgeOutWhereNoToleranceIsSet) {
  LocalizerConfig config = judged_config();
  config.tolerance.rest_mm = std::numeric_limits<double>::infinity();
  Desk desk(1, config);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 50.0, 50.0)), PointState::rejected);
}

TEST(VerdictAtEdge, JudgesAPointInFrontOfTheEndOfAJoint) {
  Desk desk(1);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.3, 0.1, FootBorder::joint_end)), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::cut);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.3, 0.25, FootBorder::joint_end)), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::none);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.19, 0.1, FootBorder::joint_end)), PointState::rejected);
}

TEST(VerdictAtEdge, SaysWhyAPointIsRejected) {
  Desk desk(1);
  desk.store[0].outside_window = true;
  EXPECT_EQ(desk.state(kAbove), PointState::rejected);
  EXPECT_EQ(verdict_of(desk.store[0]).left_out, LeftOut::window);
  EXPECT_FALSE(verdict_of(desk.store[0]).fitted);
  desk.store[0].outside_window = false;
  EXPECT_EQ(desk.state(kAbove), PointState::out);
  EXPECT_EQ(verdict_of(desk.store[0]).left_out, LeftOut::none);
  EXPECT_TRUE(verdict_of(desk.store[0]).fitted);
}

/// Where edges count, a point on one is judged by its distance.
TEST(VerdictAtEdge, JudgesAPointOnAnOuterEdgeThatCounts) {
  LocalizerConfig config = judged_config();
  config.edges = EdgePolicy::use;
  Desk desk(1, config);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.1, 0.1)), PointState::in);
  EXPECT_EQ(desk.state(beyond_edge(kOnRest, 0.3, 0.1)), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::none) << "there is no surface to cut to";
}

/// What a refinement made of a point on the way says nothing of the point.
TEST(VerdictAtEdge, JudgesAPointThatStayedOutOfTheFitByItsFoot) {
  Desk desk(2);
  desk.selection.by_exits(desk.store);
  desk.store[0].exits = tuning::kMostExits;
  desk.judge(0, kBelow);
  EXPECT_EQ(desk.store[0].state, PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::weld);
  EXPECT_FALSE(desk.store[0].fitted);
  desk.selection.by_foot();
  desk.see(0, beyond_edge(0.0, 0.1, 0.0));
  desk.see(1, kWithin);
  desk.selection.hold(desk.store);
  desk.judge(0, kWithin);
  EXPECT_EQ(desk.store[0].state, PointState::in) << "held out, but its foot is interior now";
  desk.judge(1, beyond_edge(0.0, 0.1, 0.0));
  EXPECT_EQ(desk.store[1].state, PointState::in) << "it counts, wherever its foot has gone";
}

}  // namespace
}  // namespace bladefit::testing
