// Outliers, and what a robust fit judges otherwise.
#include <gtest/gtest.h>

#include <set>

#include "tools/batch/batch_fit.hpp"
#include "tools/batch/outliers.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {
namespace {

const StudyCase& blade() {
  static const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  return study;
}

std::vector<ProbePoint> good_points() { return read_subset_points(blade(), "200"); }

/// Moves a touch against its probing direction.
void put_off(ProbePoint& point, double excess_mm) {
  for (std::size_t k = 0; k < 3; ++k) point.position[k] -= excess_mm * point.approach[k];
}

std::set<std::uint32_t> named(const std::vector<ProbePoint>& points) {
  std::set<std::uint32_t> sequences;
  for (const Outlier& outlier : fit_points(blade().design, blade().plan, points, "points").result.outliers.points)
    sequences.insert(outlier.sequence);
  return sequences;
}

TEST(OutliersNamed, AreNoneOfGoodPoints) { EXPECT_TRUE(named(good_points()).empty()); }

TEST(OutliersNamed, OneGrossErrorMakesNoGoodPointAnOutlier) {
  for (const double excess : {1.0, 3.0, 8.0}) {
    for (const std::size_t at : {3U, 60U, 199U}) {
      std::vector<ProbePoint> points = good_points();
      put_off(points[at], excess);
      EXPECT_EQ(named(points), std::set<std::uint32_t>{points[at].sequence}) << excess << " mm at " << at;
    }
  }
}

TEST(OutliersNamed, ManyThatLieTogetherDoNotHideEachOther) {
  std::vector<ProbePoint> points = good_points();
  std::set<std::uint32_t> wrong;
  for (std::size_t at = 80; at < 110; ++at) {
    put_off(points[at], 2.0);
    wrong.insert(points[at].sequence);
  }
  EXPECT_EQ(named(points), wrong);
}

/// Of so many points the robust fit takes some; the others are judged at its pose.
TEST(OutliersNamed, AlsoAmongPointsThatTheRobustFitLeavesOut) {
  const std::vector<ProbePoint> good = good_points();
  std::vector<ProbePoint> points;
  for (std::uint32_t k = 0; k < 17000; ++k) {
    points.push_back(good[k % good.size()]);
    points.back().sequence = k + 1;
  }
  std::set<std::uint32_t> wrong;
  for (std::size_t at = 8000; at < 8060; ++at) {
    put_off(points[at], 3.0);
    wrong.insert(points[at].sequence);
  }
  EXPECT_EQ(named(points), wrong);
}

TEST(OutliersNamed, NobodyWhereTheScaleIsThatOfRounding) {
  FitReport report;
  report.determined = 6;
  report.sigma_mm = 0.005;
  Rows<Residual> residuals;
  for (std::uint32_t i = 0; i < 40; ++i) {
    ProbePoint point;
    Verdict verdict;
    point.sequence = verdict.sequence = i + 1;
    verdict.state = PointState::in;
    verdict.fitted = true;
    verdict.foot.distance = i == 5 ? 4e-12 : 1e-13 * (i % 7);
    residuals.push_back(residual_of(point, verdict));
  }
  EXPECT_TRUE(find_outliers(report, 150.0, residuals).points.empty());
  residuals.change_each([](Residual residual) {
    residual.distance_mm *= 1e9;
    return residual;
  });
  EXPECT_EQ(find_outliers(report, 150.0, residuals).points.size(), 1U) << "the same in larger";
}

/// A defect that spreads over a sixth of the points draws the least-squares fit towards itself.
TEST(RobustCheck, NamesThePointsThatItJudgesOtherwise) {
  std::vector<ProbePoint> points = good_points();
  FitPlan plan = blade().plan;
  plan.localizer.tolerance.leading_edge_mm = plan.localizer.tolerance.rest_mm = 0.3;
  EXPECT_TRUE(fit_points(blade().design, plan, points, "points").result.judged_otherwise.empty());
  for (std::size_t at = 80; at < 115; ++at) put_off(points[at], 0.3);
  const Result pulled = fit_points(blade().design, plan, points, "points").result;
  EXPECT_FALSE(pulled.judged_otherwise.empty());
  plan.localizer.loss = Loss::tukey;
  const Result robust = fit_points(blade().design, plan, points, "points").result;
  for (const std::uint32_t sequence : pulled.judged_otherwise) {
    const auto state = [sequence](const Result& result) { return result.points[sequence - 1].state; };
    EXPECT_NE(state(pulled), state(robust)) << sequence;
  }
  EXPECT_TRUE(robust.judged_otherwise.empty()) << "a fit with a loss speaks for itself";
}

}  // namespace
}  // namespace bladefit
