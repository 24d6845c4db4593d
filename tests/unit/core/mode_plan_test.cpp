// What each mode is.

#include <gtest/gtest.h>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

using enum FitMode;

constexpr FitMode kEveryMode[] = {least_squares, minimax, range, min_tolerance, constrained};
constexpr double kInfinite = std::numeric_limits<double>::infinity();

ToleranceMap tolerances(double leading_edge, double rest, double transition = 0) {
  ToleranceMap map;
  map.boxes[0] = {0, 0.4, 0.6, 0.0, 1.0};
  map.box_count = 1;
  map.leading_edge_mm = leading_edge;
  map.rest_mm = rest;
  map.transition = transition;
  return map;
}

struct Planned {
  Planned(FitMode mode, const ToleranceMap& map, double ratio = 10)
      : problem(reference_design("dtmb4119").image(), config(mode, map, ratio)), plan(problem) {}
  static LocalizerConfig config(FitMode mode, const ToleranceMap& map, double ratio) {
    LocalizerConfig out;
    out.mode = mode;
    out.tolerance = map;
    out.ratio = ratio;
    return out;
  }
  /// Where it is the same on both sides.
  [[nodiscard]] double weight(double u) const {
    const Limits weight = plan.weight(foot_at(u, 0.0));
    EXPECT_EQ(weight.plus(), weight.minus());
    return weight.plus();
  }

  FitProblem problem;
  ModePlan plan;
};

TEST(ModePlan, HasARowForEveryMode) {
  for (const FitMode mode : kEveryMode) {
    EXPECT_EQ(mode_row(mode).mode, mode);
    EXPECT_EQ(Planned(mode, tolerances(0.1, 1.0)).plan.row().mode, mode);
    EXPECT_EQ(Planned(mode, tolerances(0.1, 1.0)).plan.bounded(), mode != least_squares);
    EXPECT_EQ(Planned(mode, tolerances(0.1, 1.0)).plan.may_be_infeasible(), mode == constrained);
  }
}

TEST(ModePlan, OfTwoStagesBeginsWithTheSimplerProgram) {
  for (const FitMode mode : kEveryMode) {
    const FitMode first = mode == range ? minimax : mode == constrained ? min_tolerance : mode;
    EXPECT_EQ(mode_row(mode).first, first);
    EXPECT_EQ(mode_row(mode).last, mode);
    EXPECT_EQ(mode_row(mode).sought, mode == constrained ? min_tolerance : mode);
  }
}

TEST(ModePlan, KnowsWhatItsOptimumIs) {
  for (const FitMode mode : kEveryMode) {
    const ModeRow& row = mode_row(mode);
    EXPECT_EQ(row.has_value, mode == minimax || mode == range || mode == min_tolerance);
    EXPECT_EQ(row.has_certificate, mode == minimax || mode == min_tolerance);
    EXPECT_EQ(row.value_is_tolerance, mode == min_tolerance);
    EXPECT_EQ(row.compared == ModeRow::Compared::by_range, mode == range);
    EXPECT_EQ(row.compared == ModeRow::Compared::by_bound, mode == min_tolerance || mode == constrained);
  }
}

TEST(ModePlan, GoesOnWithARangeAlwaysAndWithATolerancesFitWhereItIsFeasible) {
  for (const double value : {0.5, 1.0, 1.0 + 0.5 * tuning::kFeasible, 1.0 + 1e-9, 7.0}) {
    for (const FitMode mode : kEveryMode) {
      const bool wanted = mode == range || (mode == constrained && value < 1.0 + 1e-10);
      EXPECT_EQ(Planned(mode, tolerances(0.1, 1.0)).plan.goes_on(value), wanted) << value;
    }
  }
}

TEST(ModePlan, WeighsByTheTolerancesOfAConstrainedFit) {
  const Planned plan(constrained, tolerances(0.02, 0.3));
  EXPECT_EQ(plan.weight(0.5), 0.02);
  EXPECT_EQ(plan.weight(0.1), 0.3);
  EXPECT_EQ(plan.plan.unit(), 0.02);
}

TEST(ModePlan, BoundsNothingWhereThereIsNoTolerance) {
  const Planned edge(constrained, tolerances(kInfinite, 0.3));
  EXPECT_EQ(edge.weight(0.5), 0.0);
  EXPECT_EQ(edge.weight(0.1), 0.3);
  EXPECT_EQ(edge.plan.unit(), 0.3) << "values are multiples of the tolerance that there is";
}

TEST(ModePlan, WeighsOtherModesByOneAndTheRatioWhateverTheTolerances) {
  for (const FitMode mode : {least_squares, minimax, range, min_tolerance}) {
    const Planned plan(mode, tolerances(0.02, kInfinite), 7.0);
    EXPECT_EQ(plan.weight(0.5), 1.0);
    EXPECT_EQ(plan.weight(0.1), 7.0);
    EXPECT_EQ(plan.plan.unit(), 1.0);
  }
}

ToleranceMap lopsided_zone() {
  ToleranceMap map = tolerances(kInfinite, 0.3);
  map.boxes[0].zone = 1;
  map.zones[0] = {Region::leading_edge, false, 0.0, kInfinite, 0.1, 0.04};
  map.zone_count = 1;
  return map;
}

TEST(ModePlan, WeighsByTheLimitsOfZonesWhateverTheRatio) {
  for (const FitMode mode : {min_tolerance, constrained}) {
    const Planned plan(mode, lopsided_zone(), 7.0);
    EXPECT_EQ(plan.plan.weight(foot_at(0.5, 0.0)).plus(), 0.1);
    EXPECT_EQ(plan.plan.weight(foot_at(0.5, 0.0)).minus(), 0.04);
    EXPECT_EQ(plan.weight(0.1), 0.3);
    EXPECT_EQ(plan.plan.unit(), 0.04);
  }
  ToleranceMap band = lopsided_zone();
  band.zones[0].region = Region::rest;
  EXPECT_EQ(Planned(constrained, band).plan.unit(), 0.04) << "the tightest of the rest where no edge has one";
}

TEST(ModePlan, OtherModesCountPointsInZonesThatJudgeNothing) {
  ToleranceMap map = lopsided_zone();
  map.zones[0].plus_mm = map.zones[0].minus_mm = map.rest_mm = kInfinite;
  for (const FitMode mode : {minimax, range}) {
    EXPECT_GT(Planned(mode, map).weight(0.5), 0.0);
    EXPECT_GT(Planned(mode, map).weight(0.1), 0.0);
  }
}

TEST(ModePlan, WeighsInTheTransitionZoneBetweenTheTwo) {
  const Planned ratio(min_tolerance, tolerances(0.02, 0.3, 0.1), 7.0);
  EXPECT_EQ(ratio.weight(0.6), 1.0);
  EXPECT_NEAR(ratio.weight(0.65), 4.0, 1e-12);
  EXPECT_NEAR(ratio.weight(0.375), 2.5, 1e-12);
  EXPECT_EQ(ratio.weight(0.71), 7.0);
  EXPECT_NEAR(Planned(constrained, tolerances(0.1, 0.3, 0.1)).weight(0.65), 0.2, 1e-12);
}

TEST(ModePlan, TakesFromAProgramOnlyWhatItHas) {
  Certificate proof;
  proof.count = 3;
  for (const FitMode mode : kEveryMode) {
    ModeOptimum optimum;
    optimum.value = 9.0;
    optimum.take(mode_row(mode), 0.4, proof);
    EXPECT_EQ(optimum.value, mode_row(mode).has_value ? 0.4 : 0.0);
    EXPECT_EQ(optimum.certificate.count, mode_row(mode).has_certificate ? 3U : 0U);
  }
}

TEST(ModePlan, NamesThePointsOfACertificateByTheirSequences) {
  OwnedStore store(3);
  for (const std::uint32_t sequence : {40U, 50U, 60U}) store.append(numbered(sequence));
  ActiveRows rows;
  rows.count = 2;
  rows.index = {2, 0};
  rows.multiplier = {0.25, 0.75};
  rows.sign = {-1, 1};
  const Certificate certificate = certificate_of(rows, store, 0.5);
  EXPECT_EQ(certificate.count, 2U);
  EXPECT_EQ(certificate.sequence[0], 60U);
  EXPECT_EQ(certificate.sequence[1], 40U);
  EXPECT_EQ(certificate.multiplier[0], 0.125);
  EXPECT_EQ(certificate.multiplier[1], 0.375);
  EXPECT_EQ(certificate.sign[0], -1);
  EXPECT_EQ(certificate.sign[1], 1);
}

}  // namespace
}  // namespace bladefit::testing
