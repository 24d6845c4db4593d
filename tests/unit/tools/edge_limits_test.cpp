// The limits of the leading edge from root to tip, as the web panel draws them.

#include "tools/web/edge_limits.hpp"

#include <gtest/gtest.h>

#include <array>

namespace bladefit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A grid with these radii about the x axis.
FaceMesh grid_of(std::initializer_list<double> radii) {
  FaceMesh mesh;
  for (const double radius : radii) mesh.points.emplace_back(7.0, 0.0, radius);
  return mesh;
}

/// The outer edge, the whole blade from a radius of 90 on, and the whole edge, in this order.
ToleranceMap edge_map() {
  ToleranceMap map;
  map.boxes[0].zone = 1;
  map.boxes[1].zone = 3;
  map.box_count = 2;
  map.zones[0] = {Region::leading_edge, false, 70.0, kInfinite, 0.1, 0.05};
  map.zones[1] = {Region::rest, true, 90.0, kInfinite, 0.3, 0.3};
  map.zones[2] = {Region::leading_edge, false, 0.0, kInfinite, 0.2, kInfinite};
  map.zone_count = 3;
  return map;
}

TEST(EdgeLimits, AreThoseOfTheFirstZoneAtEachRadius) {
  const std::array meshes = {grid_of({60, 75, 85}), grid_of({40, 60, 100})};
  const std::vector<EdgeLimits> limits = edge_limits(edge_map(), meshes);
  ASSERT_EQ(limits.size(), 3U);
  EXPECT_EQ(limits[0].low_mm, 40);
  EXPECT_EQ(limits[0].high_mm, 70);
  EXPECT_EQ(limits[0].limits.plus(), 0.2);
  EXPECT_EQ(limits[0].limits.minus(), kInfinite);
  EXPECT_EQ(limits[1].low_mm, 70);
  EXPECT_EQ(limits[1].high_mm, 85);
  EXPECT_EQ(limits[1].limits.minus(), 0.05);
  EXPECT_EQ(limits[2].low_mm, 85);
  EXPECT_EQ(limits[2].high_mm, 90) << "the edge is no zone of its own beyond";
  EXPECT_EQ(limits[2].limits.plus(), 0.2);
}

TEST(EdgeLimits, WithoutZonesThereAreNone) {
  ToleranceMap map = edge_map();
  map.zone_count = 0;
  EXPECT_TRUE(edge_limits(map, std::array{grid_of({60}), grid_of({40})}).empty());
}

TEST(EdgeLimits, AZoneThatReachesNoRadiusHasNone) {
  const std::array meshes = {grid_of({50, 60}), grid_of({40, 60})};
  const std::vector<EdgeLimits> limits = edge_limits(edge_map(), meshes);
  ASSERT_EQ(limits.size(), 1U) << "the first zone's band begins beyond its boxes";
  EXPECT_EQ(limits[0].high_mm, 60);
}

}  // namespace
}  // namespace bladefit
