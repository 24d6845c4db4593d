// Gaps between faces, and narrow faces that are none.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tools/design/design_doubts.hpp"
#include "tools/design/face_choice.hpp"
#include "tools/design/nurbs/crossings.hpp"
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

/// A sheet across those above, from z = `low` to `high`, in the plane x = 20.
NurbsSurface standing_sheet(double low, double high) {
  NurbsSurface surface = flat_sheet(0, 0);
  surface.control_points = {{20, 10, low}, {20, 60, low}, {20, 10, high}, {20, 60, high}};
  return surface;
}

TEST(DesignGaps, SurfacesThatPassThroughEachOtherAreFoundAndThoseThatTouchAreNot) {
  const std::vector<Crossing> found = find_crossings({flat_sheet(0, 50), standing_sheet(-20, 30)}, 0.1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].surface, 0U);
  EXPECT_EQ(found[0].other, 1U);
  EXPECT_NEAR(found[0].extent_mm, 50, 4.0);
  EXPECT_NEAR((found[0].place - Eigen::Vector3d(20, 35, 0)).norm(), 0, 2.0);
  EXPECT_TRUE(find_crossings({flat_sheet(0, 50), standing_sheet(0, 30)}, 0.1).empty());
  EXPECT_TRUE(find_crossings({flat_sheet(0, 50), standing_sheet(-0.05, 30)}, 0.1).empty());
  EXPECT_TRUE(find_crossings({arched_sheet(60, 100), arched_sheet(100, 150)}, 0.1).empty());
}

TEST(DesignGaps, WhatIsTrimmedOffPassesThroughNothing) {
  NurbsSurface trimmed = standing_sheet(-20, 30);
  const auto vertex = [](double u, double v) {
    TrimVertex result{};
    result.u = u;
    result.v = v;
    return result;
  };
  trimmed.trims = {{vertex(0.4, 0), vertex(1, 0), vertex(1, 1), vertex(0.4, 1)}};
  EXPECT_TRUE(find_crossings({flat_sheet(0, 50), trimmed}, 0.1).empty());
  for (TrimVertex& place : trimmed.trims[0]) place.u = place.u == 0.4 ? 0.2 : place.u;
  EXPECT_EQ(find_crossings({flat_sheet(0, 50), trimmed}, 0.1).size(), 1U);
}

TEST(DesignGaps, ASheetThatIsFoldedThroughItselfIsFound) {
  NurbsSurface loop = flat_sheet(0, 0);
  loop.u = {3, 4, {0, 0, 0, 0, 1, 1, 1, 1}, 0.0, 1.0};
  loop.control_points.clear();
  for (const auto& [x, z] : {std::pair{0.0, 0.0}, {150.0, 100.0}, {-100.0, 100.0}, {50.0, 0.0}}) {
    for (const double y : {0.0, 40.0}) loop.control_points.emplace_back(x, y, z);
  }
  loop.weights.assign(8, 1.0);
  const std::vector<Crossing> found = find_crossings({loop}, 0.1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].other, 0U);
}

DesignFile design_of(std::vector<NurbsSurface> surfaces, const std::vector<double>& areas) {
  DesignFile design;
  design.surfaces = std::move(surfaces);
  for (const double area : areas) {
    DesignFace& face = design.faces.emplace_back();
    face.entity = "face #" + std::to_string(design.faces.size());
    face.kind = "plane";
    face.area = area;
  }
  return design;
}

bool is_told(const std::vector<std::string>& lines, const std::string& what) {
  for (const std::string& line : lines) {
    if (line.find(what) != std::string::npos) return true;
  }
  return false;
}

TEST(DesignGaps, CrossingsAndCopiesAreToldOfTheDesign) {
  const std::vector<std::string> crossed =
      design_doubts(design_of({flat_sheet(0, 50), standing_sheet(-20, 30)}, {5000, 2500}));
  EXPECT_TRUE(is_told(crossed, "face #1 and face #2 pass through each other over"));
  EXPECT_FALSE(is_told(crossed, "in one place"));
  const std::vector<std::string> twice = design_doubts(design_of({flat_sheet(0, 50), flat_sheet(0, 50)}, {5000, 5000}));
  EXPECT_TRUE(is_told(twice, "1 pair of faces in one place, such as face #1 and face #2"));
}

TEST(DesignGaps, TrimmedPlanesAreCapsOnlyWhileTheyAreASmallPart) {
  for (const double cap : {500.0, 3000.0}) {
    DesignFile design = design_of({flat_sheet(0, 50), flat_sheet(50, 60)}, {5000, cap});
    design.surfaces[1].trims = {TrimLoop(3)};
    leave_flat_caps(design);
    EXPECT_EQ(design.surfaces.size(), cap < 1000 ? 1U : 2U);
  }
}

}  // namespace
}  // namespace bladefit
