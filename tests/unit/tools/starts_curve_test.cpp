// Curves through passes, and first feet that come from them.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/localizer_fixtures.hpp"
#include "tools/batch/first_feet.hpp"
#include "tools/batch/path_curve.hpp"

namespace bladefit::testing {
namespace {

std::vector<Vec3> random_points(std::size_t count, std::mt19937_64& random) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < count; ++k) points.push_back(10.0 * random_vector(random));
  return points;
}

/// Rises from 0 to 1 in `count` steps of different length.
std::vector<double> random_parameters(std::size_t count, std::mt19937_64& random) {
  std::vector<double> parameters{0};
  for (std::size_t k = 1; k < count; ++k) parameters.push_back(parameters.back() + uniform(random, 0.1, 1.0));
  const double length = parameters.back();
  for (double& t : parameters) t /= length;
  return parameters;
}

/// Points of a cubic at their parameters give the cubic itself back.
RC_GTEST_PROP(PathCurve, ReproducesCubics, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto count = static_cast<std::size_t>(*rc::gen::inRange(4, 60));
  const PathCurve cubic{random_points(4, random)};
  const std::vector<double> parameters = random_parameters(count, random);
  std::vector<Vec3> points;
  for (const double t : parameters) points.push_back(cubic.at(t));
  const auto fitted = fit_path_curve(points, parameters);
  RC_ASSERT(fitted.has_value());
  RC_ASSERT(fitted->control_points.size() == 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    RC_ASSERT((fitted->control_points[k] - cubic.control_points[k]).norm() < 1e-9);
  }
}

/// With chord-length parameters up to four points are passed through, and a straight pass is itself.
RC_GTEST_PROP(PathCurve, ChordParametersAreExactWhereTheyCanBe, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const bool straight = *rc::gen::arbitrary<bool>();
  const auto count = static_cast<std::size_t>(straight ? *rc::gen::inRange(2, 40) : *rc::gen::inRange(2, 5));
  std::vector<Vec3> points = random_points(count, random);
  if (straight) {
    const std::vector<double> along = random_parameters(count, random);
    const Vec3 from = points.front(), to = points.back();
    for (std::size_t k = 0; k < count; ++k) points[k] = from + along[k] * (to - from);
  }
  const auto path = fit_path(points);
  RC_ASSERT(path.has_value());
  RC_ASSERT(path->parameters.front() == 0.0 && path->parameters.back() == 1.0);
  for (std::size_t k = 0; k < count; ++k) {
    RC_ASSERT((path->curve.at(path->parameters[k]) - points[k]).norm() < 1e-9);
  }
}

TEST(PathCurve, TooLittleIsNoCurve) {
  EXPECT_FALSE(fit_path({}).has_value());
  const std::vector<Vec3> one{Vec3(1, 2, 3)}, same(5, Vec3(1, 2, 3));
  EXPECT_FALSE(fit_path(one).has_value());
  EXPECT_FALSE(fit_path(same).has_value());
  EXPECT_EQ(places_on_curves({}).size(), 0U);
  EXPECT_EQ(places_on_curves(same), same);
}

/// A pass round a thin section is halved until its curves are close.
TEST(PathCurve, APassRoundTheLeadingEdgeIsHalved) {
  std::vector<Vec3> points;
  for (int k = 0; k <= 200; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 200.0;
    points.emplace_back(100.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0);
  }
  const std::vector<Vec3> places = places_on_curves(points);
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_LT((places[k] - points[k]).norm(), 0.4) << k;
}

class FirstFeet : public ::testing::Test {
 protected:
  FirstFeet()
      : case_(read_case("arl_fan")),
        design_(reference_design("arl_fan")),
        points_(points_of(case_, "full")),
        config_(config_of(case_, points_.size())) {}

  ReferenceCase case_;
  const CompiledDesign& design_;
  std::vector<ProbePoint> points_;
  LocalizerConfig config_;
};

/// Along dense passes the curve's foot needs one search a pass, and leads every point to its nearest foot.
TEST_F(FirstFeet, CurvesLeadToTheNearestFeet) {
  const FirstPlaces along = places_along_curves(design_.surface(), config_, points_);
  EXPECT_EQ(along.searches, 10U);
  OwnedLocalizer tracked(design_.image(), config_), searched(design_.image(), config_);
  EXPECT_EQ(stage_points(*tracked, design_.surface(), config_, points_, FootStarts::curves, "points"), 10U);
  EXPECT_EQ(stage_points(*searched, design_.surface(), config_, points_, FootStarts::searched, "points"), 0U);
  EXPECT_EQ(tracked->fit().searches, 0U);
  EXPECT_LT(searched->fit().searches, points_.size() / 10) << "the others were proven by their reach";
  for (const ProbePoint& point : points_) {
    Verdict a, b;
    ASSERT_EQ(tracked->verdict_of(point.sequence, a), Status::ok);
    ASSERT_EQ(searched->verdict_of(point.sequence, b), Status::ok);
    EXPECT_LT((a.foot.point - b.foot.point).norm(), 1e-9);
  }
}

/// A place that is not on the design changes nothing.
TEST_F(FirstFeet, StartsOffTheDesignAreRefused) {
  OwnedLocalizer localizer(design_.image(), config_);
  const auto spans = static_cast<std::uint32_t>(design_.image().spans().size());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const SurfacePlace& place : {SurfacePlace{spans, 0.5, 0.5}, SurfacePlace{0, -0.1, 0.5},
                                    SurfacePlace{0, 0.5, 1.1}, SurfacePlace{0, nan, 0.5}, SurfacePlace{0, 0.5, nan}}) {
    EXPECT_EQ(localizer->stage_from(points_[0], place), Status::out_of_range);
  }
  EXPECT_EQ(localizer->fit().points, 0U);
  EXPECT_EQ(localizer->stage_from(points_[0], {0, 0.0, 0.0}), Status::ok);
  EXPECT_EQ(localizer->stage_from(points_[0], {0, 0.0, 0.0}), Status::duplicate);
}

/// Feet that were only tracked so far are all proven in the last sweep: searched, where nothing is known of their
/// reach.
TEST_F(FirstFeet, RefinementSearchesEveryFoot) {
  const CompiledDesign design = without_reach(design_);
  OwnedLocalizer localizer(design.image(), config_);
  ASSERT_EQ(stage_points(*localizer, design.surface(), config_, points_, FootStarts::neighbour, "points"), 10U);
  localizer->conclude();
  EXPECT_EQ(refine_fully(*localizer), Status::ok);
  EXPECT_EQ(localizer->fit().status, FitStatus::converged);
  EXPECT_GE(localizer->fit().searches, points_.size());
}

}  // namespace
}  // namespace bladefit::testing
