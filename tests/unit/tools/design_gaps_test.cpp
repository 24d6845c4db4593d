// Gaps between faces, and narrow faces that are none.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tools/design/nurbs/neighbours.hpp"

namespace bladefit {
namespace {

constexpr double kClosed_mm = 0.1, kApart_mm = 0.5;

/// A flat sheet over x from `low` to `high` and y from `from` to `to`.
NurbsSurface flat_sheet(double low, double high, double from = 0, double to = 100) {
  NurbsSurface surface;
  surface.name = "sheet";
  surface.u = surface.v = {1, 2, {0, 0, 1, 1}, 0.0, 1.0};
  surface.control_points = {{low, from, 0}, {low, to, 0}, {high, from, 0}, {high, to, 0}};
  surface.weights.assign(4, 1.0);
  return surface;
}

TEST(DesignGaps, TwoFacesApartHaveOne) {
  const std::vector<Neighbours> gaps = find_gaps({flat_sheet(0, 50), flat_sheet(50.42, 100)}, kClosed_mm, kApart_mm);
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_EQ(gaps[0].surface, 0U);
  EXPECT_EQ(gaps[0].other, 1U);
  EXPECT_NEAR(gaps[0].gap_mm, 0.42, 1e-12);
}

TEST(DesignGaps, ANarrowFaceBetweenTwoFillsIt) {
  EXPECT_TRUE(
      find_gaps({flat_sheet(0, 50), flat_sheet(50, 50.42), flat_sheet(50.42, 100)}, kClosed_mm, kApart_mm).empty());
}

TEST(DesignGaps, SeveralNarrowFacesFillItTogetherAndOneMissingLeavesIt) {
  const NurbsSurface lower = flat_sheet(50, 50.42, 0, 40), upper = flat_sheet(50, 50.42, 40, 100);
  EXPECT_TRUE(find_gaps({flat_sheet(0, 50), lower, upper, flat_sheet(50.42, 100)}, kClosed_mm, kApart_mm).empty());
  const std::vector<Neighbours> gaps =
      find_gaps({flat_sheet(0, 50), lower, flat_sheet(50.42, 100)}, kClosed_mm, kApart_mm);
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_NEAR(gaps[0].gap_mm, 0.42, 1e-12);
}

/// A sheet between the arc of `radius` about the origin and that of `other`, of half a turn.
NurbsSurface arched_sheet(double radius, double other) {
  NurbsSurface surface = flat_sheet(0, 0);
  surface.u = {2, 5, {0, 0, 0, 0.5, 0.5, 1, 1, 1}, 0.0, 1.0};
  surface.control_points.clear();
  surface.weights.clear();
  for (const auto& [x, y, weight] : {std::tuple{1.0, 0.0, 1.0},
                                     {1.0, 1.0, std::sqrt(0.5)},
                                     {0.0, 1.0, 1.0},
                                     {-1.0, 1.0, std::sqrt(0.5)},
                                     {-1.0, 0.0, 1.0}}) {
    for (const double r : {radius, other}) {
      surface.control_points.emplace_back(r * x, r * y, 0);
      surface.weights.push_back(weight);
    }
  }
  return surface;
}

/// The points of two bent edges need not be beside each other: chords between them are off by 0.1 mm here.
TEST(DesignGaps, ABentEdgeThatTwoFacesShareIsNone) {
  NurbsSurface outer = arched_sheet(100, 150);
  outer.u.knots = {0, 0, 0, 0.37, 0.37, 1, 1, 1};
  EXPECT_TRUE(find_gaps({arched_sheet(60, 100), outer}, 0.01, kApart_mm).empty());
  EXPECT_EQ(find_gaps({arched_sheet(60, 99.9), outer}, 0.01, kApart_mm).size(), 1U);
}

TEST(DesignGaps, WhatTouchesOrIsFarOffIsNone) {
  EXPECT_TRUE(find_gaps({flat_sheet(0, 50), flat_sheet(50.05, 100)}, kClosed_mm, kApart_mm).empty());
  EXPECT_TRUE(find_gaps({flat_sheet(0, 50), flat_sheet(50.6, 100)}, kClosed_mm, kApart_mm).empty());
}

}  // namespace
}  // namespace bladefit
