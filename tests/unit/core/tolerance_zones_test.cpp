// Zones with limits of their own on either side: which one a place belongs to, and how a point in it is judged.

#include <gtest/gtest.h>

#include <limits>

#include "core/inspection/blade_verdict.hpp"
#include "core/localizer/check_config.hpp"
#include "tests/unit/core/verdict_desk.hpp"

namespace bladefit::testing {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// The edge from a radius of 70 to 100 [mm], all else from there on, and the edge below.
ToleranceMap three_zones() {
  ToleranceMap map;
  map.boxes[0] = {0, 0.4, 0.6, 0.0, 1.0, 1};
  map.boxes[1] = {0, 0.4, 0.6, 0.0, 1.0, 3};
  map.box_count = 2;
  map.zones[0] = {Region::leading_edge, false, 70.0, 100.0, 0.1, 0.05};
  map.zones[1] = {Region::rest, true, 70.0, 100.0, 0.3, 0.2};
  map.zones[2] = {Region::leading_edge, false, 0.0, kNone, 0.15, 0.15};
  map.zone_count = 3;
  map.rest_mm = 0.5;
  map.axis = {Vec3(0, 0, 10), Vec3::UnitX()};
  return map;
}

/// A foot at a radius about the axis of those zones.
Foot foot_of(double u, double radius, double distance) {
  Foot foot = foot_at(u, distance);
  foot.point = Vec3(-7, 0, 10 + radius);
  return foot;
}

std::uint32_t zone_of(const ToleranceMap& map, double u, double radius) {
  return part_at(map, 0, u, 0.5, foot_of(u, radius, 0).point).zone;
}

TEST(ToleranceZones, TheFirstThatHoldsAPlaceWins) {
  const ToleranceMap map = three_zones();
  EXPECT_EQ(zone_of(map, 0.5, 80), 1U);
  EXPECT_EQ(zone_of(map, 0.7, 80), 2U);
  EXPECT_EQ(zone_of(map, 0.5, 60), 3U);
  EXPECT_EQ(zone_of(map, 0.7, 60), 0U);
  EXPECT_EQ(part_at(map, 0, 0.5, 0.5, Vec3(0, 80, 10)).region, Region::leading_edge);
  EXPECT_EQ(part_at(map, 0, 0.7, 0.5, Vec3(0, 80, 10)).region, Region::rest);
  EXPECT_EQ(part_at(map, 1, 0.5, 0.5, Vec3(0, 60, 10)).zone, 0U) << "another patch";
}

TEST(ToleranceZones, ABandHoldsItsLimits) {
  const ToleranceMap map = three_zones();
  EXPECT_EQ(zone_of(map, 0.7, 70.0), 2U);
  EXPECT_EQ(zone_of(map, 0.7, 69.999), 0U);
  EXPECT_EQ(zone_of(map, 0.7, 100.0), 2U);
  EXPECT_EQ(zone_of(map, 0.7, 100.001), 0U);
}

TEST(ToleranceZones, WithoutZonesTheLeadingEdgeIsAsItWas) {
  ToleranceMap map;
  map.boxes[0] = {0, 0.4, 0.6, 0.0, 1.0};
  map.box_count = 1;
  EXPECT_EQ(part_at(map, 0, 0.5, 0.5, Vec3::Zero()).region, Region::leading_edge);
  EXPECT_EQ(part_at(map, 0, 0.5, 0.5, Vec3::Zero()).zone, 0U);
}

TEST(ToleranceZones, TheTightestOfARegionIsThatOfEitherSide) {
  ToleranceMap map = three_zones();
  EXPECT_EQ(tightest_of(map, Region::leading_edge), 0.05);
  EXPECT_EQ(tightest_of(map, Region::rest), 0.2);
  EXPECT_TRUE(sets_tolerance(map));
  EXPECT_TRUE(judges_everywhere(map));
  map.zones[1].plus_mm = map.rest_mm = kNone;
  EXPECT_TRUE(sets_tolerance(map));
  EXPECT_FALSE(judges_everywhere(map));
}

LocalizerConfig zoned_config() {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 32);
  config.tolerance = three_zones();
  return config;
}

TEST(ToleranceZones, APointIsJudgedByTheLimitOnItsSide) {
  Desk desk(1, zoned_config());
  EXPECT_EQ(desk.state(foot_of(0.5, 80, 0.08)), PointState::in);
  EXPECT_EQ(desk.store[0].tolerance, 0.1);
  EXPECT_EQ(desk.store[0].zone, 1U);
  EXPECT_EQ(desk.state(foot_of(0.5, 80, -0.08)), PointState::out);
  EXPECT_EQ(desk.store[0].tolerance, 0.05);
  EXPECT_EQ(desk.store[0].action, Action::weld);
  EXPECT_EQ(desk.book.out(Region::leading_edge), 1U);
  EXPECT_EQ(desk.state(foot_of(0.5, 80, 0.11)), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::cut);
  EXPECT_EQ(desk.state(foot_of(0.5, 80, -0.04)), PointState::in);
  EXPECT_EQ(desk.book.out(Region::leading_edge), 0U);
}

TEST(ToleranceZones, OnEitherSideOfABandOtherLimitsHold) {
  Desk desk(1, zoned_config());
  EXPECT_EQ(desk.state(foot_of(0.5, 70.001, 0.12)), PointState::out);
  EXPECT_EQ(desk.state(foot_of(0.5, 69.999, 0.12)), PointState::in);
  EXPECT_EQ(desk.store[0].zone, 3U);
  EXPECT_EQ(desk.state(foot_of(0.7, 70.001, -0.25)), PointState::out);
  EXPECT_EQ(desk.state(foot_of(0.7, 69.999, -0.25)), PointState::in);
  EXPECT_EQ(desk.store[0].zone, 0U);
  EXPECT_EQ(desk.store[0].tolerance, 0.5);
  EXPECT_EQ(verdict_of(desk.store[0]).zone, 0U);
}

TEST(ToleranceZones, BeyondAnEdgeNeitherSideIsTaken) {
  Desk desk(1, zoned_config());
  const auto beyond = [](double distance) {
    Foot foot = foot_of(0.5, 80, distance);
    foot.kind = FootKind::edge;
    foot.border = FootBorder::outer;
    foot.beyond = distance;
    return foot;
  };
  EXPECT_EQ(desk.state(beyond(0.04)), PointState::rejected);
  EXPECT_EQ(desk.state(beyond(0.08)), PointState::undecided) << "in by one limit, out by the other";
  EXPECT_EQ(desk.state(beyond(0.12)), PointState::out);
  EXPECT_EQ(desk.store[0].action, Action::none);
}

TEST(ToleranceZones, APointIsPendingByTheNearerLimit) {
  Desk desk(1, zoned_config());
  const double start = tuning::kStartUncertainty * desk.problem.frame.length;
  Vec6 open = Vec6::Zero();
  open[5] = 0.99 * tuning::kPendingShare * 0.05 / start;  // along the normal
  desk.know_pose(open);
  EXPECT_EQ(desk.state(foot_of(0.5, 80, 0.02)), PointState::in);
  desk.know_pose(open * (1.01 / 0.99));
  EXPECT_EQ(desk.state(foot_of(0.5, 80, 0.02)), PointState::pending);
}

TEST(ToleranceZones, EachNeedsJudgedPointsOfItsOwn) {
  const ToleranceMap map = three_zones();
  ZoneCount zones(map);
  EXPECT_EQ(zones.missed(), 3U);
  Verdict verdict;
  verdict.state = PointState::in;
  for (const auto zone : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}}) {
    verdict.zone = zone;
    verdict.foot.u = 0.5;  // in the boxes of the first and of the third
    zones.count(verdict, 1);
  }
  EXPECT_EQ(zones.missed(), 1U);
  EXPECT_TRUE(zones.lacks_points(2));
  EXPECT_EQ(zones.points(0), 1U);
}

struct RefusedZones {
  const char* field;
  void (*change)(LocalizerConfig& config);
};

class ZonesRefused : public ::testing::TestWithParam<RefusedZones> {};

TEST_P(ZonesRefused, ByTheField) {
  LocalizerConfig config;
  config.tolerance = three_zones();
  ASSERT_FALSE(check_config(config, 1));
  GetParam().change(config);
  const ConfigFault fault = check_config(config, 1);
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault.field, GetParam().field);
}

INSTANTIATE_TEST_SUITE_P(
    Fields, ZonesRefused,
    ::testing::Values(
        RefusedZones{"tolerance.zone_count", [](LocalizerConfig& c) { c.tolerance.zone_count = 17; }},
        RefusedZones{"tolerance.zones.plus_mm", [](LocalizerConfig& c) { c.tolerance.zones[1].plus_mm = 0; }},
        RefusedZones{"tolerance.zones.minus_mm", [](LocalizerConfig& c) { c.tolerance.zones[0].minus_mm = -0.05; }},
        RefusedZones{"tolerance.zones.radius_low_mm",
                     [](LocalizerConfig& c) { c.tolerance.zones[0].radius_low_mm = -1; }},
        RefusedZones{"tolerance.zones.radius_high_mm",
                     [](LocalizerConfig& c) { c.tolerance.zones[0].radius_high_mm = 70; }},
        RefusedZones{"tolerance.zones.everywhere", [](LocalizerConfig& c) { c.tolerance.boxes[1].zone = 1; }},
        RefusedZones{"tolerance.boxes.zone", [](LocalizerConfig& c) { c.tolerance.boxes[1].zone = 2; }},
        RefusedZones{"tolerance.boxes.zone", [](LocalizerConfig& c) { c.tolerance.boxes[1].zone = 0; }},
        RefusedZones{"tolerance.boxes.zone", [](LocalizerConfig& c) { c.tolerance.boxes[1].zone = 40; }},
        RefusedZones{"tolerance.transition", [](LocalizerConfig& c) { c.tolerance.transition = 0.1; }},
        RefusedZones{"tolerance.axis.direction", [](LocalizerConfig& c) { c.tolerance.axis.direction *= 2; }},
        RefusedZones{"tolerance.rest_mm",
                     [](LocalizerConfig& c) { c.mode = FitMode::min_tolerance, c.tolerance.rest_mm = kNone; }},
        RefusedZones{"tolerance.rest_mm",
                     [](LocalizerConfig& c) { c.mode = FitMode::constrained, c.tolerance.rest_mm = kNone; }},
        RefusedZones{"tolerance.zones.plus_mm", [](LocalizerConfig& c) {
                       c.mode = FitMode::min_tolerance, c.tolerance.zones[1].plus_mm = kNone;
                     }}));

}  // namespace
}  // namespace bladefit::testing
