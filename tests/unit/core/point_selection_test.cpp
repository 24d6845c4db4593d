// Which points count in the fit, and to which region they belong.

#include <gtest/gtest.h>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/verdict_desk.hpp"

namespace bladefit::testing {
namespace {

FitProblem problem_with(EdgePolicy edges) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 10);
  config.edges = edges;
  return {reference_design("dtmb4119").image(), config};
}

const Foot kInside = foot_at(kOnRest, 0.0), kOnBorder = foot_at(0.0, 0.0, FootKind::edge),
           kAtCorner = foot_at(0.0, 0.0, FootKind::corner);

TEST(PointSelection, ByFootLeavesOutFeetOnBordersAndPointsOutsideTheWindow) {
  const FitProblem problem = problem_with(EdgePolicy::skip);
  const PointSelection selection(problem);
  StoredPoint point = numbered(1);
  point.exits = UINT8_MAX;  // counts by exits alone
  EXPECT_FALSE(selection.left_out(point, kInside));
  EXPECT_TRUE(selection.left_out(point, kOnBorder));
  EXPECT_TRUE(selection.left_out(point, kAtCorner));
  point.outside_window = true;
  EXPECT_TRUE(selection.left_out(point, kInside));
}

TEST(PointSelection, CountsFeetOnBordersWhereTheConfigurationSaysSo) {
  const FitProblem problem = problem_with(EdgePolicy::use);
  const PointSelection selection(problem);
  StoredPoint point = numbered(1);
  EXPECT_FALSE(selection.left_out(point, kOnBorder));
  EXPECT_FALSE(selection.left_out(point, kAtCorner));
  point.outside_window = true;
  EXPECT_TRUE(selection.left_out(point, kOnBorder));
}

TEST(PointSelection, CountsAnExitOnlyWhereAPointThatCountsLeaves) {
  const FitProblem problem = problem_with(EdgePolicy::skip);
  const PointSelection selection(problem);
  StoredPoint point = numbered(1);
  const auto goes = [&](const Foot& next) {
    selection.note_exit(point, next);
    point.foot = next;
    return static_cast<int>(point.exits);
  };
  point.foot = kInside;
  EXPECT_EQ(goes(kInside), 0);
  EXPECT_EQ(goes(kOnBorder), 1);
  EXPECT_EQ(goes(kAtCorner), 1);
  EXPECT_EQ(goes(kInside), 1);
  EXPECT_EQ(goes(kOnBorder), 2);
  point.exits = UINT8_MAX;
  point.foot = kInside;
  EXPECT_EQ(goes(kOnBorder), UINT8_MAX) << "the count does not begin again at 0";
}

TEST(PointSelection, ByExitsKeepsOutAPointThatWasLeftOutTooOften) {
  const FitProblem problem = problem_with(EdgePolicy::skip);
  PointSelection selection(problem);
  OwnedStore store(2);
  store.append(numbered(1));
  store[0].exits = 9;
  selection.by_exits(store);
  EXPECT_EQ(store[0].exits, 0) << "counted from here on";
  for (int k = 0; k < tuning::kMostExits; ++k) {
    EXPECT_FALSE(selection.left_out(store[0], kInside)) << k;
    store[0].foot = kInside;
    selection.note_exit(store[0], kOnBorder);
  }
  EXPECT_TRUE(selection.left_out(store[0], kInside));
  selection.by_foot();
  EXPECT_FALSE(selection.left_out(store[0], kInside));
}

/// What left because the pose travelled comes in again at the optimum; what leaves again stays out.
TEST(PointSelection, ReadmitsOnceWhatStayedOutAndWhoseFootCountsNow) {
  const FitProblem problem = problem_with(EdgePolicy::skip);
  PointSelection selection(problem);
  OwnedStore store(3);
  for (const std::uint32_t sequence : {1U, 2U, 3U}) store.append(numbered(sequence));
  selection.by_exits(store);
  EXPECT_FALSE(selection.readmit(store)) << "nothing stayed out";
  for (const std::uint32_t i : {0U, 1U}) store[i].exits = tuning::kMostExits;
  store[0].foot = kInside;
  store[1].foot = kOnBorder;
  store[2].foot = kInside;
  EXPECT_TRUE(selection.readmit(store));
  EXPECT_FALSE(selection.left_out(store[0], kInside));
  EXPECT_TRUE(selection.left_out(store[1], kInside)) << "its foot did not count";
  store[0].exits = tuning::kMostExits;
  EXPECT_FALSE(selection.readmit(store)) << "the refinement must end";
  EXPECT_TRUE(selection.left_out(store[0], kInside));
  selection.by_exits(store);
  store[0].exits = tuning::kMostExits;
  EXPECT_TRUE(selection.readmit(store)) << "the next refinement may again";
}

TEST(PointSelection, HoldKeepsRegionAndMembershipWhereverFeetGo) {
  const FitProblem problem = problem_with(EdgePolicy::skip);
  PointSelection selection(problem);
  OwnedStore store(2);
  for (const std::uint32_t sequence : {1U, 2U}) store.append(numbered(sequence));
  store[0].foot = foot_at(kOnEdgeOfBlade, 0.0);
  store[0].region = Region::leading_edge;
  store[1].foot = kOnBorder;
  EXPECT_FALSE(selection.held());
  selection.hold(store);
  EXPECT_TRUE(selection.held());
  for (const Foot& foot : {kInside, kOnBorder, kAtCorner}) {
    EXPECT_FALSE(selection.left_out(store[0], foot));
    EXPECT_TRUE(selection.left_out(store[1], foot));
    EXPECT_EQ(selection.region(store[0], foot), Region::leading_edge);
  }
  selection.by_foot();
  EXPECT_FALSE(selection.held());
  EXPECT_TRUE(selection.left_out(store[0], kOnBorder));
  EXPECT_EQ(selection.region(store[0], kInside), Region::rest);
  EXPECT_EQ(selection.region(store[1], foot_at(kOnEdgeOfBlade, 0.0)), Region::leading_edge);
}

TEST(PointSelection, HoldLeavesOutWhatExitsLeftOut) {
  const FitProblem problem = problem_with(EdgePolicy::skip);
  PointSelection selection(problem);
  OwnedStore store(1);
  store.append(numbered(1));
  store[0].foot = kInside;
  selection.by_exits(store);
  store[0].exits = tuning::kMostExits;
  selection.hold(store);
  EXPECT_TRUE(selection.left_out(store[0], kInside));
}

}  // namespace
}  // namespace bladefit::testing
