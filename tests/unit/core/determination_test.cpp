// What the points determine while they come in: a bad pose is not taken for noise, and none is kept for good.
#include <gtest/gtest.h>

#include "core/fit/pose_solver.hpp"
#include "tests/support/localizer_session.hpp"

namespace bladefit::testing {
namespace {

/// What a start that is off leaves over is explained by a motion, not by noise: it delays nothing.
TEST(CoreDetermination, AStartThatIsOffDelaysNothing) {
  const BladeSession s;
  std::vector<int> determined_at;
  for (const double off : {0.0, 1.5, 3.0, 5.0}) {
    LocalizerConfig config = s.config;
    config.start.translation = Vec3(0, off, 0);
    OwnedLocalizer stream(s.design.image(), config);
    Verdict verdict;
    std::size_t count = 0;
    while (stream->fit().determined < 6 && count < 1000) {
      ASSERT_TRUE(succeeded(stream->push(s.points[count++], verdict)));
    }
    determined_at.push_back(static_cast<int>(count));
  }
  for (const int count : determined_at) EXPECT_NEAR(count, determined_at[0], 10) << "points";
  EXPECT_LT(determined_at[0], 300);
}

/// A fit over too few points, concluded early, may be far off. Points that come later bring it back.
TEST(CoreDetermination, APoseFromTooFewPointsIsNotKept) {
  const BladeSession s;
  const std::vector<ProbePoint> points = thinned(s.reference, 37, 5);
  for (const std::size_t early : {6U, 7U, 10U, 20U}) {
    OwnedLocalizer stream(s.design.image(), s.config);
    Verdict verdict;
    for (std::size_t i = 0; i < 300; ++i) {
      ASSERT_TRUE(succeeded(stream->push(points[i], verdict)));
      if (i + 1 != early) continue;
      stream->conclude();
      static_cast<void>(refine_fully(*stream));
    }
    const FitReport report = stream->fit();
    EXPECT_EQ(report.determined, 6U) << early;
    EXPECT_LT(report.rms_mm, 0.06) << early;
  }
}

/// Few points of a blade with large deviations of form: they determine little, and the pose stays with the start.
TEST(CoreDetermination, LargeDeviationsOfFormDoNotThrowThePoseOff) {
  const ReferenceCase c = read_case("arl_fan");
  const CompiledDesign& design = reference_design("arl_fan");
  for (const ReferenceSubset& subset : c.subsets) {
    const std::vector<ProbePoint> points = points_of(c, subset);
    OwnedLocalizer stream(design.image(), config_of(c, points.size()));
    Verdict verdict;
    for (const ProbePoint& point : points) {
      ASSERT_TRUE(succeeded(stream->push(point, verdict)));
      const FitReport report = stream->fit();
      ASSERT_LT(report.pose.translation.norm(), 5.0) << subset.name << ", point " << point.sequence;
      ASSERT_LT(report.rms_mm, 1.0) << subset.name << ", point " << point.sequence;
    }
  }
}

TEST(CoreDetermination, TheNoiseBoundIsAboveTheNoise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.3);
  int above = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    QuadraticModel model;
    Vec6 motion;
    for (int k = 0; k < 6; ++k) motion[k] = uniform(random, -2, 2);
    for (int i = 0; i < 12; ++i) {
      DistanceRow row;
      for (int k = 0; k < 6; ++k) row.gradient[k] = uniform(random, -1, 1);
      row.distance = row.gradient.dot(motion) + noise(random);
      model.add(row, Vec6::Zero(), 1.0, loss_terms(Loss::none, 0.0, row.distance));
    }
    const MotionSpectrum spectrum = spectrum_of(model);
    const double bound = noise_bound(model, spectrum, Vec6::Zero(), 100.0);
    above += bound > 0.09 ? 1 : 0;
    EXPECT_GE(noise_bound(model, spectrum, Vec6::Zero(), 0.1), bound) << "what a short motion leaves over";
  }
  EXPECT_GT(above, kTrials * 98 / 100);
}

TEST(CoreDetermination, ThereIsNoNoiseBoundOfSixPoints) {
  QuadraticModel model;
  for (int i = 0; i < 6; ++i) {
    DistanceRow row;
    row.gradient = Vec6::Unit(i);
    model.add(row, Vec6::Zero(), 1.0, loss_terms(Loss::none, 0.0, 0.0));
  }
  EXPECT_TRUE(std::isinf(noise_bound(model, spectrum_of(model), Vec6::Zero(), 1.0)));
}

}  // namespace
}  // namespace bladefit::testing
