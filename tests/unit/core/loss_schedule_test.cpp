// The loss in use and its scale.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

constexpr double kFar = 10.0;  ///< a distance that every loss treats in its own way [mm]

LocalizerConfig loss_config(Loss loss, double scale) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 200);
  config.loss = loss;
  config.loss_scale_mm = scale;
  return config;
}

struct Scales {
  explicit Scales(Loss wanted, double scale = 0)
      : problem(reference_design("dtmb4119").image(), loss_config(wanted, scale)),
        selection(problem),
        store(200),
        loss(problem) {}

  void set(const std::vector<double>& distances) {
    store.clear();
    for (const double d : distances) {
      StoredPoint point = numbered(store.size() + 1);
      point.foot = foot_at(0.1, d);
      store.append(point);
    }
  }
  [[nodiscard]] bool adapt() { return loss.adapt(store, selection); }
  [[nodiscard]] bool is(Loss other) const {
    return loss.terms(kFar).slope == loss_terms(other, loss.scale(), kFar).slope;
  }

  FitProblem problem;
  PointSelection selection;
  OwnedStore store;
  LossSchedule loss;
};

std::vector<double> drawn_distances(std::size_t count, std::mt19937_64& random) {
  std::vector<double> out(count);
  for (double& d : out) d = uniform(random, -1.0, 1.0);
  return out;
}

/// The smallest size that half of the distances do not exceed.
double median_size(std::vector<double> distances) {
  for (double& d : distances) d = std::abs(d);
  std::sort(distances.begin(), distances.end());
  return distances[(distances.size() - 1) / 2];
}

TEST(LossSchedule, ScalesByTheMedianOfThePointsThatCount) {
  std::mt19937_64 random(3);
  for (const std::size_t count : {1U, 2U, 3U, 10U, 51U, 150U}) {
    Scales scales(Loss::huber);
    const std::vector<double> distances = drawn_distances(count, random);
    scales.set(distances);
    for (int k = 0; k < 20; ++k) {
      StoredPoint left_out = numbered(1000 + scales.store.size());
      left_out.foot = foot_at(0.0, 99.0, FootKind::edge);
      scales.store.append(left_out);
    }
    ASSERT_TRUE(scales.adapt());
    EXPECT_NEAR(scales.loss.scale(), 1.4826 * median_size(distances), 1e-8) << count;
  }
}

TEST(LossSchedule, DoesNotScaleBelowTheNoise) {
  Scales scales(Loss::huber);
  scales.set({0.0, 1e-9, -1e-9, 0.0});
  ASSERT_TRUE(scales.adapt());
  EXPECT_EQ(scales.loss.scale(), scales.problem.config.noise_floor_mm);
}

TEST(LossSchedule, GoesFromLeastSquaresByHuberToTukeyAndRests) {
  Scales scales(Loss::tukey);
  EXPECT_FALSE(scales.loss.robust());
  EXPECT_EQ(scales.loss.scale(), 0.0);
  scales.set({0.1, -0.2, 0.3});
  EXPECT_TRUE(scales.adapt());
  EXPECT_TRUE(scales.loss.robust());
  EXPECT_TRUE(scales.is(Loss::huber));
  scales.set({0.11, -0.22, 0.33});
  EXPECT_TRUE(scales.adapt());
  EXPECT_TRUE(scales.is(Loss::huber)) << "its scale is not near rest";
  EXPECT_NEAR(scales.loss.scale(), 1.4826 * 0.22, 1e-8);
  scales.set({0.1101, -0.2202, 0.3303});
  EXPECT_TRUE(scales.adapt());
  EXPECT_TRUE(scales.is(Loss::tukey)) << "near rest";
  scales.set({0.1102, -0.2204, 0.3306});
  EXPECT_TRUE(scales.adapt()) << "Tukey's scale is not at rest";
  EXPECT_FALSE(scales.adapt());
  EXPECT_TRUE(scales.is(Loss::tukey));
}

TEST(LossSchedule, OfHuberRestsInHubers) {
  Scales scales(Loss::huber);
  scales.set({0.1, -0.2, 0.3});
  EXPECT_TRUE(scales.adapt());
  EXPECT_FALSE(scales.adapt());
  EXPECT_TRUE(scales.is(Loss::huber));
}

TEST(LossSchedule, EndsWhereItsScaleNeverRests) {
  Scales scales(Loss::huber);
  std::uint32_t rounds = 0;
  double distance = 1.0;
  do {
    distance = 1.5 * distance;
    scales.set({distance});
  } while (scales.adapt() && ++rounds < 1000);
  EXPECT_EQ(rounds, tuning::kScaleRounds);
}

TEST(LossSchedule, BeginsAgainWithLeastSquares) {
  Scales scales(Loss::tukey);
  scales.set({0.1, -0.2, 0.3});
  while (scales.adapt()) EXPECT_TRUE(scales.loss.robust());
  scales.loss.restart();
  EXPECT_FALSE(scales.loss.robust());
  EXPECT_EQ(scales.loss.scale(), 0.0);
  EXPECT_TRUE(scales.is(Loss::none));
  EXPECT_TRUE(scales.adapt());
  EXPECT_TRUE(scales.is(Loss::huber));
}

TEST(LossSchedule, NeverAdaptsAScaleThatIsGiven) {
  Scales scales(Loss::tukey, 0.25);
  scales.set({0.1, -0.2, 0.3});
  EXPECT_TRUE(scales.loss.robust());
  EXPECT_FALSE(scales.adapt());
  scales.loss.restart();
  EXPECT_TRUE(scales.is(Loss::tukey));
  EXPECT_EQ(scales.loss.scale(), 0.25);
}

TEST(LossSchedule, OfLeastSquaresHasNoScale) {
  Scales scales(Loss::none);
  scales.set({0.1, -0.2, 0.3});
  EXPECT_FALSE(scales.adapt());
  EXPECT_FALSE(scales.loss.robust());
  EXPECT_EQ(scales.loss.terms(kFar).slope, kFar);
}

}  // namespace
}  // namespace bladefit::testing
