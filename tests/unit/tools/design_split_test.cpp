#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/nurbs/patch_split.hpp"

namespace bladefit {
namespace {

using testing::evaluate_surface;
using testing::random_surface;

/// A part is a valid surface over 0..1 whose points are those of the whole.
void expect_same_points(const NurbsSurface& surface, const ParameterRectangle& limits) {
  NurbsSurface part = part_of(surface, limits);
  ASSERT_TRUE(check_surface(part, "part").empty());
  for (const SurfaceDirection* direction : {&part.u, &part.v}) {
    EXPECT_EQ(std::pair(direction->start, direction->end), std::pair(0.0, 1.0));
    EXPECT_EQ(direction->knots[static_cast<std::size_t>(direction->degree)], 0);
    EXPECT_EQ(direction->knots.front(), 0);
    EXPECT_EQ(direction->knots.back(), 1);
  }
  for (const double s : {0.0, 0.17, 0.5, 0.83, 1.0}) {
    for (const double t : {0.0, 0.29, 0.61, 1.0}) {
      const Eigen::Vector3d expected = evaluate_surface(surface, limits.u_min + s * (limits.u_max - limits.u_min),
                                                        limits.v_min + t * (limits.v_max - limits.v_min));
      EXPECT_LT((evaluate_surface(part, s, t) - expected).norm(), 1e-12) << s << " " << t;
    }
  }
}

RC_GTEST_PROP(PatchSplit, PartsHaveThePointsOfTheWhole, ()) {
  const auto degree_u = *rc::gen::inRange(1, 8);
  const auto degree_v = *rc::gen::inRange(1, 5);
  const bool clamped = *rc::gen::arbitrary<bool>();
  const bool sub_range = *rc::gen::arbitrary<bool>();
  const bool rational = *rc::gen::arbitrary<bool>();
  NurbsSurface surface = random_surface({degree_u, 4, clamped, sub_range, clamped}, {degree_v, 3, !clamped, !sub_range},
                                        rational, *rc::gen::arbitrary<std::uint32_t>());
  check_surface(surface, "whole");
  const double low = *rc::gen::inRange(0, 60) / 100.0;
  const double high = low + *rc::gen::inRange(1, 40) / 100.0;
  expect_same_points(surface, {low, high, 0, 1});
  expect_same_points(surface, {0, 1, low, high});
  expect_same_points(surface, {low, 1, 0, high});
  expect_same_points(surface, {0, 1, 0, 1});
}

TEST(PatchSplit, CutsAtKnotsAddNone) {
  NurbsSurface surface = random_surface({3, 4, true, false, true}, {2, 2}, true, 9);
  for (std::size_t k = 0; k < surface.u.knots.size(); ++k) {
    const double knot = surface.u.knots[k];
    if (knot == surface.u.start || knot == surface.u.end) continue;
    // The normalised knot is not exactly the knot again; the cut must find it all the same.
    const double at = (knot - surface.u.start) / (surface.u.end - surface.u.start);
    const NurbsSurface left = part_of(surface, {0, at, 0, 1});
    const NurbsSurface right = part_of(surface, {at, 1, 0, 1});
    const auto multiplicity = std::count(surface.u.knots.begin(), surface.u.knots.end(), knot);
    EXPECT_EQ(left.u.knots.size() + right.u.knots.size(),
              surface.u.knots.size() + static_cast<std::size_t>(2 * (surface.u.degree + 1) - multiplicity));
    expect_same_points(surface, {0, at, 0, 1});
    expect_same_points(surface, {at, 1, 0, 1});
  }
}

TEST(PatchSplit, NeighboursShareTheirSeam) {
  const NurbsSurface surface = random_surface({3, 4}, {3, 4}, true, 10);
  const NurbsSurface left = part_of(surface, {0, 0.33, 0, 1});
  const NurbsSurface right = part_of(surface, {0.33, 1, 0, 1});
  const auto count = static_cast<std::size_t>(surface.v.control_points);
  const std::size_t last = left.control_points.size() - count;
  for (std::size_t j = 0; j < count; ++j) {
    EXPECT_EQ(left.control_points[last + j], right.control_points[j]);
    EXPECT_EQ(left.weights[last + j], right.weights[j]);
  }
}

TEST(PatchSplit, PolynomialPatchesStayPolynomial) {
  const NurbsSurface part = part_of(random_surface({}, {}, false, 11), {0.2, 0.7, 0.1, 0.9});
  for (const double weight : part.weights) EXPECT_EQ(weight, 1);
}

TEST(PatchSplit, CutsDivideInOrder) {
  const std::vector<ParameterRectangle> parts = divided({{0.3, 0.6}, {0.5}});
  ASSERT_EQ(parts.size(), 6U);
  EXPECT_EQ(parts[1].u_max, 0.3);
  EXPECT_EQ(parts[1].v_min, 0.5);
  EXPECT_EQ(parts[4].u_min, 0.6);
  EXPECT_EQ(parts[4].v_max, 0.5);
}

}  // namespace
}  // namespace bladefit
