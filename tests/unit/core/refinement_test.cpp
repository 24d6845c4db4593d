// A refinement over stored points: its phases, and that how it is cut into calls changes no bit.

#include "core/localizer/refinement.hpp"

#include <gtest/gtest.h>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

constexpr std::uint32_t kStored = 203;  // no multiple of the lanes

LocalizerConfig config_of_mode(FitMode mode, std::uint32_t starts) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), kStored);
  config.mode = mode;
  config.further_starts = starts;
  return config;
}

/// Points that are stored 1 mm away from where they belong.
struct Refined {
  explicit Refined(FitMode mode, std::uint32_t starts = 0)
      : parts(reference_design("dtmb4119").image(), config_of_mode(mode, starts)) {
    const std::vector<ProbePoint> all = points_of(read_case("dtmb4119"), "full");
    std::vector<ProbePoint> some;
    for (std::size_t i = 0; i < kStored; ++i) some.push_back(all[i * all.size() / kStored]);
    parts.store(some);
    parts.sweep();
  }

  void begin() { parts->refinement.begin(true, parts->optimum); }
  Status advance(std::uint32_t points) { return parts->refinement.advance(points, true, parts->optimum); }
  /// To the end, in calls of so many points.
  Status run(std::uint32_t points) {
    Status status = Status::more_work;
    for (int call = 0; call < 100000 && status == Status::more_work; ++call) status = advance(points);
    return status;
  }

  OwnedParts parts;
};

TEST(RefinementPart, IsTheSameHoweverItIsCut) {
  for (const FitMode mode : {FitMode::least_squares, FitMode::minimax}) {
    Refined whole(mode);
    whole.begin();
    ASSERT_EQ(whole.run(UINT32_MAX), Status::ok);
    for (const std::uint32_t points : {1U, 3U, 7U, 64U}) {
      Refined cut(mode);
      cut.begin();
      ASSERT_EQ(cut.run(points), Status::ok);
      EXPECT_TRUE(same_bits(cut.parts->estimate.pose(), whole.parts->estimate.pose())) << points;
      EXPECT_EQ(cut.parts->sums.model().gauss, whole.parts->sums.model().gauss) << points;
      EXPECT_EQ(cut.parts->optimum.value, whole.parts->optimum.value) << points;
    }
  }
}

TEST(RefinementPart, EndsWhereAFreshSweepFindsTheMinimum) {
  Refined refined(FitMode::least_squares);
  refined.begin();
  ASSERT_EQ(refined.run(100), Status::ok);
  EXPECT_EQ(refined.parts->refinement.phase(), RefinementPhase::done);
  EXPECT_EQ(refined.parts->refinement.ended(), FitEnd::none);
  EXPECT_EQ(refined.parts->refinement.unproven(), 0U);
  refined.parts.sweep();
  const QuadraticModel& model = refined.parts->sums.model();
  EXPECT_LT(model.gradient.norm(), 1e-10 * model.gauss.trace());
}

TEST(RefinementPart, GoesOnFromWhereItWasInterrupted) {
  Refined whole(FitMode::least_squares), stopped(FitMode::least_squares);
  whole.begin();
  ASSERT_EQ(whole.run(UINT32_MAX), Status::ok);
  stopped.begin();
  ASSERT_EQ(stopped.advance(kStored + 50), Status::more_work);  // in the midst of the second sweep
  stopped.parts->refinement.interrupt();
  EXPECT_EQ(stopped.parts->refinement.phase(), RefinementPhase::idle);
  // What the sweep had taken is in the sums that pushes go on with, each point once.
  while (!stopped.parts->sums.refresh(stopped.parts->store, stopped.parts->estimate, 16,
                                      [](std::uint32_t, const Measurement&) {})) {
  }
  stopped.parts->sums.settle_all(stopped.parts->store, stopped.parts->estimate);
  stopped.begin();
  ASSERT_EQ(stopped.run(UINT32_MAX), Status::ok);
  const Vec6 apart =
      motion_between(whole.parts->estimate.pose(), stopped.parts->estimate.pose(), whole.parts->problem.frame);
  EXPECT_LT(apart.norm(), 1e-11 * whole.parts->problem.frame.length);
}

/// Its mode's programs and further starts come between least squares and the end.
TEST(ModeFitPart, TakesThePhasesInTheirOrder) {
  Refined refined(FitMode::minimax, 2);
  refined.begin();
  std::vector<RefinementPhase> phases = {refined.parts->refinement.phase()};
  Status status = Status::more_work;
  for (int call = 0; call < 100000 && status == Status::more_work; ++call) {
    status = refined.advance(kLanes);
    if (refined.parts->refinement.phase() != phases.back()) phases.push_back(refined.parts->refinement.phase());
  }
  ASSERT_EQ(status, Status::ok);
  ASSERT_GE(phases.size(), 4U);
  EXPECT_EQ(phases[0], RefinementPhase::least_squares);
  EXPECT_EQ(phases[1], RefinementPhase::mode);
  EXPECT_EQ(phases[2], RefinementPhase::further_starts);
  EXPECT_EQ(phases.back(), RefinementPhase::done);
  EXPECT_TRUE(refined.parts->refinement.further_starts().done());
  double largest = 0;
  for (std::uint32_t i = 0; i < refined.parts->store.size(); ++i) {
    const StoredPoint& point = refined.parts->store[i];
    if (!point.held_out) largest = std::max(largest, std::abs(point.foot.distance));
  }
  EXPECT_NEAR(refined.parts->optimum.value, largest, 1e-10);
}

TEST(ModeFitPart, IsNoWorseThanLeastSquares) {
  Refined squares(FitMode::least_squares), minimax(FitMode::minimax);
  squares.begin();
  minimax.begin();
  ASSERT_EQ(squares.run(UINT32_MAX), Status::ok);
  ASSERT_EQ(minimax.run(UINT32_MAX), Status::ok);
  double largest = 0;
  for (std::uint32_t i = 0; i < squares.parts->store.size(); ++i) {
    const Foot& foot = squares.parts->store[i].foot;
    if (foot.kind == FootKind::interior) largest = std::max(largest, std::abs(foot.distance));
  }
  EXPECT_LT(minimax.parts->optimum.value, largest);
}

}  // namespace
}  // namespace bladefit::testing
