// Whether 95 of 100 intervals hold the truth: 200 fits of points with errors that are known.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/localizer_session.hpp"

namespace bladefit::testing {
namespace {

constexpr int kFits = 200;
constexpr std::size_t kTouches = 120;
constexpr double kNoise = 0.02;        ///< [mm], standard deviation along the normal
constexpr double kTwoSided95 = 1.981;  ///< Student's t of 114 degrees of freedom

/// Where a blade was touched: on its design, and how far off along the normal.
struct Touched {
  Vec3 point, normal;
  double phase;  ///< of a smooth form error, 0..2 pi along the blade
};

std::vector<Touched> touched_places(const CompiledDesign& design, std::mt19937_64& random) {
  std::vector<Touched> out;
  while (out.size() < kTouches) {
    const SurfacePlace place = random_place(design.surface(), random);
    if (std::min({place.u, place.v, 1.0 - place.u, 1.0 - place.v}) < 0.05) continue;
    const SurfacePoint at = design.surface().evaluate(place);
    out.push_back({at.s, design.surface().normal(place, at), 2.0 * std::numbers::pi * place.v});
  }
  return out;
}

Pose inverse(const Pose& pose) { return {pose.rotation.transpose(), -(pose.rotation.transpose() * pose.translation)}; }

/// How many of the intervals held the truth.
struct Coverage {
  int held = 0, intervals = 0;
  void count(double error, double uncertainty) {
    ++intervals;
    if (std::abs(error) <= kTwoSided95 * uncertainty) ++held;
  }
  [[nodiscard]] double share() const { return static_cast<double>(held) / intervals; }
};

struct Coverages {
  Coverage pose, distances;
};

/// `form`: amplitude [mm] of an error that is the same in every fit.
Coverages covered(const std::string& name, double form) {
  const CompiledDesign& design = reference_design(name);
  std::mt19937_64 random(20);
  const std::vector<Touched> places = touched_places(design, random);
  const Pose truth{rotation_exp(Vec3(0.002, -0.001, 0.003)), Vec3(0.2, -0.1, 0.15)};
  const Pose to_machine = inverse(truth);
  LocalizerConfig config;
  config.capacity = kTouches;
  config.noise_floor_mm = 1e-6;
  std::normal_distribution<double> noise(0.0, kNoise);
  Coverages out;
  for (int fit = 0; fit < kFits; ++fit) {
    OwnedLocalizer localizer(design.image(), config);
    std::vector<double> off;
    for (std::size_t i = 0; i < places.size(); ++i) {
      off.push_back(noise(random) + form * std::sin(places[i].phase));
      const Vec3 r = apply(to_machine, places[i].point + off.back() * places[i].normal);
      EXPECT_EQ(localizer->stage({static_cast<std::uint32_t>(i + 1), 0, {r[0], r[1], r[2]}, {}, 0}), Status::ok);
    }
    localizer->conclude();
    EXPECT_EQ(refine_fully(*localizer), Status::ok);
    const FitReport report = localizer->fit();
    const Vec6 error = pose_difference(truth, report.pose);
    for (int k = 0; k < 6; ++k) out.pose.count(error[k], std::sqrt(report.covariance(k, k)));
    for (std::size_t i = 0; i < places.size(); i += 10) {
      Verdict verdict;
      EXPECT_EQ(localizer->verdict_of(static_cast<std::uint32_t>(i + 1), verdict), Status::ok);
      out.distances.count(verdict.foot.distance - off[i], verdict.uncertainty_mm);
    }
  }
  return out;
}

class Uncertainty : public ::testing::TestWithParam<const char*> {};

TEST_P(Uncertainty, OfPoseAndDistancesHoldsForIndependentErrors) {
  const Coverages found = covered(GetParam(), 0.0);
  for (const Coverage& coverage : {found.pose, found.distances}) {
    EXPECT_GE(coverage.share(), 0.92);
    EXPECT_LE(coverage.share(), 0.98);
  }
  std::printf("%s: noise alone: pose %.3f, distances %.3f of the 95 %% intervals hold\n", GetParam(),
              found.pose.share(), found.distances.share());
}

/// A smooth form error is not independent from point to point: what it does to the pose is the same in every fit, and
/// is no part of the uncertainty.
TEST_P(Uncertainty, DoesNotCoverWhatASmoothFormErrorDoesToThePose) {
  const Coverages found = covered(GetParam(), 5 * kNoise);
  EXPECT_LT(found.pose.share(), 0.92);
  std::printf("%s: with a form error of 5 times the noise: pose %.3f, distances %.3f\n", GetParam(), found.pose.share(),
              found.distances.share());
}

INSTANTIATE_TEST_SUITE_P(Designs, Uncertainty, ::testing::Values("arl_fan", "dtmb4119", "pnsy_sub"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace bladefit::testing
