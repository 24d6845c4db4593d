#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/loft/leading_edge.hpp"
#include "tools/design/loft/loft.hpp"
#include "tools/design/loft/spline_fit.hpp"

namespace bladefit {
namespace {

using testing::Basis;
using testing::basis_functions;

ExtendedPoint point_at(const SurfaceDirection& direction, const std::vector<ExtendedPoint>& controls, long double t) {
  const Basis basis = basis_functions(direction, t);
  ExtendedPoint sum = ExtendedPoint::Zero();
  for (std::size_t k = 0; k < basis.values.size(); ++k) sum += basis.values[k] * controls[basis.first + k];
  return sum;
}

std::vector<ExtendedPoint> extended_points(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-10, 10);
  std::vector<ExtendedPoint> points;
  for (std::size_t k = 0; k < count; ++k) points.emplace_back(number(random), number(random), number(random));
  return points;
}

std::vector<long double> even_parameters(std::size_t count) {
  std::vector<long double> parameters;
  for (std::size_t k = 0; k < count; ++k) {
    parameters.push_back(static_cast<long double>(k) / static_cast<long double>(count - 1));
  }
  return parameters;
}

/// Points of a spline give the spline itself back.
RC_GTEST_PROP(SplineFit, ReproducesSplines, ()) {
  const auto degree = *rc::gen::inRange(1, 10);
  const auto inner = *rc::gen::inRange(0, 30);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const SurfaceDirection direction = clamped_direction(degree, uniform_knots(inner));
  const auto controls = extended_points(static_cast<std::size_t>(direction.control_points), random);
  const auto parameters = even_parameters(5 * controls.size());
  std::vector<ExtendedPoint> points;
  for (const long double t : parameters) points.push_back(point_at(direction, controls, t));
  const auto fitted = fit_spline(direction, parameters, points);
  RC_ASSERT(fitted.has_value());
  for (std::size_t k = 0; k < controls.size(); ++k) RC_ASSERT(((*fitted)[k] - controls[k]).norm() < 1e-12L);
}

/// As many points as control points: the spline passes through them.
RC_GTEST_PROP(SplineFit, InterpolatesWhereItCan, ()) {
  const auto degree = *rc::gen::inRange(1, 6);
  const auto inner = *rc::gen::inRange(0, 30);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const SurfaceDirection direction = clamped_direction(degree, uniform_knots(inner));
  const auto points = extended_points(static_cast<std::size_t>(direction.control_points), random);
  const auto parameters = even_parameters(points.size());
  const auto fitted = fit_spline(direction, parameters, points);
  RC_ASSERT(fitted.has_value());
  // Even parameters are a poor choice for high degrees: control points become large, and rounding with them.
  long double size = 1;
  for (const auto& point : *fitted) size = std::max(size, point.norm());
  for (std::size_t k = 0; k < points.size(); ++k) {
    RC_ASSERT((point_at(direction, *fitted, parameters[k]) - points[k]).norm() < 1e-17L * size);
  }
}

/// Scattered points: the ends are kept, and moving any inner control point either way makes the sum of squares larger.
RC_GTEST_PROP(SplineFit, NoOtherSplineIsNearer, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const SurfaceDirection direction = clamped_direction(3, uniform_knots(6));
  const auto points = extended_points(40, random);
  const auto parameters = chord_parameters(points).value();
  auto fitted = fit_spline(direction, parameters, points).value();
  const auto sum = [&] {
    long double total = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      total += (point_at(direction, fitted, parameters[k]) - points[k]).squaredNorm();
    }
    return total;
  };
  const long double least = sum();
  RC_ASSERT(fitted.front() == points.front());
  RC_ASSERT(fitted.back() == points.back());
  for (std::size_t k = 1; k + 1 < fitted.size(); ++k) {
    for (const long double step : {1e-4L, -1e-4L}) {
      fitted[k].y() += step;
      RC_ASSERT(sum() > least);
      fitted[k].y() -= step;
    }
  }
}

TEST(SplineFit, ChordLengthsAreTheParameters) {
  std::vector<ExtendedPoint> points = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {3, 4, 1}};
  const auto parameters = chord_parameters(points).value();
  EXPECT_EQ(parameters, (std::vector<long double>{0, 3 / 8.0L, 7 / 8.0L, 1}));
  EXPECT_FALSE(chord_parameters({points[0], points[0]}).has_value());
}

TEST(SplineFit, SaysWhatIsNotDetermined) {
  std::mt19937 random(1);
  const auto points = extended_points(8, random);
  EXPECT_FALSE(fit_spline(clamped_direction(1, {0.5, 0.52, 0.54}), even_parameters(8), points).has_value());
  EXPECT_FALSE(fit_spline(clamped_direction(3, uniform_knots(5)), even_parameters(8), points).has_value());
  EXPECT_TRUE(fit_spline(clamped_direction(3, uniform_knots(4)), even_parameters(8), points).has_value());
}

/// Sections of a cylinder: the surface is one, and as near as the splines can be.
TEST(Loft, FollowsACylinder) {
  BladeSections sections;
  sections.file = "made up";
  for (int s = 0; s < 6; ++s) {
    BladeSection section{std::to_string(s), {}, {}, {}};
    const int count = 90 + s;
    for (int k = 0; k < count; ++k) {
      const double angle = 3.0 * k / (count - 1);
      section.points.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), 2.5 * s);
      section.lines.push_back(section.lines.size() + 1);
    }
    sections.sections.push_back(section);
  }
  const NurbsSurface surface = loft(sections, {}, 25.4);
  EXPECT_EQ(surface.u.control_points, 6);
  EXPECT_EQ(surface.v.control_points, 26);
  const Eigen::Vector3d middle = testing::evaluate_surface(surface, 0.37, 0.61) / 25.4;
  EXPECT_NEAR(middle.head<2>().norm(), 10, 1e-5);
  EXPECT_NEAR(middle.z(), 0.37 * 12.5, 1e-5);
  const LoftDeviation deviation = loft_deviation(surface, sections, 25.4);
  EXPECT_EQ(deviation.points, 555U);
  EXPECT_LT(deviation.largest_mm, 1e-5 * 25.4);
  EXPECT_GT(deviation.rms_mm, 0);
  // A point that stands off is found and named.
  sections.sections[4].points[30] *= 1.001;
  const LoftDeviation off = loft_deviation(surface, sections, 25.4);
  EXPECT_EQ(off.section, 4U);
  EXPECT_EQ(off.point, 30U);
  EXPECT_NEAR(off.largest_mm, 0.01 * 25.4, 1e-3);
}

TEST(Loft, TakesOtherDegreesAndKnots) {
  const BladeSections sections = read_sections_csv(BLADEFIT_TEST_DATA "/pnsy_sub/sections.csv");
  const std::vector<double> knots = {0.2, 0.4, 0.45, 0.5, 0.55, 0.6, 0.8};
  const NurbsSurface chosen = loft(sections, {.degree = 4, .span_degree = 1, .knots = knots}, 1);
  EXPECT_EQ(chosen.v.knots, (std::vector<double>{0, 0, 0, 0, 0, 0.2, 0.4, 0.45, 0.5, 0.55, 0.6, 0.8, 1, 1, 1, 1, 1}));
  EXPECT_EQ(chosen.u.degree, 1);
  EXPECT_EQ(chosen.u.control_points, 17);
  const double coarse = loft_deviation(chosen, sections, 1).rms_mm;
  const double fine = loft_deviation(loft(sections, {.control_points = 80}, 1), sections, 1).rms_mm;
  const double usual = loft_deviation(loft(sections, {}, 1), sections, 1).rms_mm;
  EXPECT_LT(fine, usual);
  EXPECT_LT(usual, coarse);
}

TEST(SplineFit, AveragedKnotsLieWhereTheParametersDo) {
  const std::vector<long double> even = even_parameters(9);
  for (const double knot : averaged_knots(even, 3)) EXPECT_TRUE(knot > 0 && knot < 1);
  std::vector<long double> dense;
  for (int k = 0; k <= 100; ++k) dense.push_back(0.5L + 0.5L * std::pow((k - 50) / 50.0L, 3));
  const std::vector<double> knots = averaged_knots(dense, 20);
  EXPECT_TRUE(std::is_sorted(knots.begin(), knots.end()));
  EXPECT_GT(std::ranges::count_if(knots, [](double knot) { return std::abs(knot - 0.5) < 0.1; }), 10);
}

TEST(Loft, FollowsThePointsWhereTheyAreDense) {
  const BladeSections sections = read_sections_csv(BLADEFIT_TEST_DATA "/pnsy_sub/sections.csv");
  const double uniform = loft_deviation(loft(sections, {}, 1), sections, 1).largest_mm;
  const double following = loft_deviation(loft(sections, {.follow_points = true}, 1), sections, 1).largest_mm;
  EXPECT_LT(following, 0.5 * uniform);
}

TEST(Loft, TellsWhereTheLeadingEdgeIs) {
  const BladeSections sections = read_sections_csv(BLADEFIT_TEST_DATA "/pnsy_sub/sections.csv");
  const std::optional<LeadingEdgeRange> edge = leading_edge_of(sections);
  ASSERT_TRUE(edge.has_value());
  EXPECT_GT(edge->v_min, 0.4);
  EXPECT_LT(edge->v_max, 0.6);
  EXPECT_LE(edge->v_min, edge->v_max);
  BladeSections open = sections;
  open.sections[3].points.resize(90);
  EXPECT_FALSE(leading_edge_of(open).has_value());
}

}  // namespace
}  // namespace bladefit
