// Modes beside least squares, point by point: against the batch optimum of the same points.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

constexpr double kEpsilon = 0.015;  ///< infeasible from about point 700 on

class StreamModes : public ::testing::TestWithParam<FitMode> {
 protected:
  StreamModes() : case_(read_case("dtmb4119")), points_(points_of(case_, "full")) {}

  [[nodiscard]] LocalizerConfig config() const {
    LocalizerConfig config = config_of(case_, points_.size());
    config.mode = GetParam();
    config.tolerance.leading_edge_mm = kEpsilon;
    config.tolerance.rest_mm = 10 * kEpsilon;
    return config;
  }

  [[nodiscard]] FitReport batch(std::size_t count) const {
    OwnedLocalizer localizer(reference_design("dtmb4119").image(), config());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(localizer->stage(points_[i]), Status::ok);
    localizer->conclude();
    EXPECT_EQ(refine_fully(*localizer), Status::ok);
    return localizer->fit();
  }

  ReferenceCase case_;
  std::vector<ProbePoint> points_;
};

/// While points come in, the value is that of the points looked at so far: below the optimum over all of them, and
/// where the program says that it has settled, the optimum. After refine() there is no difference at all.
TEST_P(StreamModes, FollowTheBatchOptimum) {
  OwnedLocalizer localizer(reference_design("dtmb4119").image(), config());
  std::size_t settled = 0, near = 0, compared = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Verdict verdict;
    ASSERT_TRUE(succeeded(localizer->push(points_[i], verdict)));
    if (i < 400 || i % 100 != 0) continue;
    const FitReport now = localizer->fit(), whole = batch(i + 1);
    const bool constrained = GetParam() == FitMode::constrained;
    const double value = constrained ? now.smallest_tolerance_mm : now.mode_value_mm;
    const double optimum = constrained ? whole.smallest_tolerance_mm : whole.mode_value_mm;
    ++compared;
    EXPECT_LT(value, optimum * 1.001) << i;
    if (value > 0.99 * optimum) ++near;
    if (now.status == FitStatus::infeasible) {
      EXPECT_EQ(whole.status, FitStatus::infeasible) << i;
      EXPECT_GT(now.certificate.count, 0U);
    }
    if (now.improving) continue;
    ++settled;
    EXPECT_NEAR(value, optimum, 1e-6 * optimum) << i;
  }
  EXPECT_GE(near, compared - 2);
  RecordProperty("settled", static_cast<int>(settled));
  localizer->conclude();
  ASSERT_EQ(refine_fully(*localizer), Status::ok);
  const FitReport fit = localizer->fit(), whole = batch(points_.size());
  EXPECT_FALSE(fit.improving);
  EXPECT_EQ(fit.status, whole.status);
  EXPECT_NEAR(fit.mode_value_mm, whole.mode_value_mm, 1e-8 * whole.mode_value_mm);
  EXPECT_LT((fit.pose.rotation - whole.pose.rotation).norm(), 1e-9);
  EXPECT_LT((fit.pose.translation - whole.pose.translation).norm(), 1e-7);
}

/// A refinement in mid stream, as at the end of a path: what follows goes on from its optimum.
TEST_P(StreamModes, GoOnFromARefinement) {
  OwnedLocalizer localizer(reference_design("dtmb4119").image(), config());
  Verdict verdict;
  for (std::size_t i = 0; i < 1000; ++i) ASSERT_TRUE(succeeded(localizer->push(points_[i], verdict)));
  ASSERT_EQ(refine_fully(*localizer), Status::ok);
  const FitReport refined = localizer->fit();
  for (std::size_t i = 1000; i < 1010; ++i) ASSERT_TRUE(succeeded(localizer->push(points_[i], verdict)));
  const FitReport now = localizer->fit();
  EXPECT_LT((now.pose.translation - refined.pose.translation).norm(), 0.02);
  const double before = std::max(refined.mode_value_mm, refined.smallest_tolerance_mm);
  EXPECT_NEAR(std::max(now.mode_value_mm, now.smallest_tolerance_mm), before, 0.02 * before);
}

INSTANTIATE_TEST_SUITE_P(Every, StreamModes,
                         ::testing::Values(FitMode::minimax, FitMode::range, FitMode::min_tolerance,
                                           FitMode::constrained));

}  // namespace
}  // namespace bladefit::testing
