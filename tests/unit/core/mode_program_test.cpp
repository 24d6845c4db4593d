// The program of a mode, and regions that follow their feet.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

using Regions = ModeProgram::Regions;

constexpr double kInTheBox = 0.5, kOutOfTheBox = 0.01;  ///< u of feet in the box of the leading edge and outside of it

LocalizerConfig program_config(FitMode mode, RegionPolicy regions, double leading_edge) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 4);
  config.mode = mode;
  config.regions = regions;
  config.tolerance.leading_edge_mm = leading_edge;
  config.tolerance.rest_mm = 1.0;
  config.tolerance.transition = 0.38;
  return config;
}

/// A program over two points with feet where a test wants them.
struct Programmed {
  explicit Programmed(FitMode mode = FitMode::min_tolerance, RegionPolicy regions = RegionPolicy::follow,
                      double leading_edge = 0.1)
      : Programmed(program_config(mode, regions, leading_edge)) {}
  explicit Programmed(const LocalizerConfig& config)
      : parts(reference_design("dtmb4119").image(), config),
        rows(BoundRows::doubles_for(4)),
        program(parts->problem, parts->plan) {
    program.attach(rows.data(), 4);
    for (const std::uint32_t sequence : {1U, 2U}) parts->store.append(numbered(sequence));
    put(kInTheBox, kOutOfTheBox);
    parts->selection.hold(parts->store);
    first_change = program.assign_regions(parts->store, parts->verdicts);
    program.begin(parts->plan.row().first, 2);
    program.set_pose(Pose());
  }
  void put(double first, double second) {
    parts->store[0].foot = foot_at(first, 0.0);
    parts->store[1].foot = foot_at(second, 0.0);
  }
  [[nodiscard]] Regions follow() { return program.follow_feet(parts->store, parts->verdicts); }
  /// Value where the points have these distances.
  [[nodiscard]] double value(double first, double second) {
    DistanceRow row;
    row.gradient = Vec6::Unit(3);
    row.distance = first;
    program.set_row(0, row);
    row.distance = second;
    program.set_row(1, row);
    return program.value();
  }

  OwnedParts parts;
  std::vector<double> rows;
  ModeProgram program;
  double first_change = 0;
};

TEST(ModeProgram, WeighsPointsByTheirRegions) {
  Programmed p;
  EXPECT_EQ(p.parts->store[0].region, Region::leading_edge);
  EXPECT_EQ(p.parts->store[1].region, Region::rest);
  EXPECT_DOUBLE_EQ(p.value(0.5, -2.0), 0.5);
  EXPECT_DOUBLE_EQ(p.value(0.1, -2.0), 0.2);
}

TEST(ModeProgram, SkipsPointsWithoutABound) {
  Programmed p(FitMode::constrained, RegionPolicy::follow, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(p.value(50.0, 0.3), 0.3);
}

TEST(ModeProgram, KeepsFixedRegionsWhereverFeetGo) {
  Programmed p(FitMode::min_tolerance, RegionPolicy::fixed);
  p.put(kOutOfTheBox, kInTheBox);
  EXPECT_EQ(p.follow(), Regions::at_rest);
  EXPECT_EQ(p.parts->store[0].region, Region::leading_edge);
}

TEST(ModeProgram, FollowsFeetOverTheBorder) {
  Programmed p;
  EXPECT_EQ(p.follow(), Regions::at_rest);
  p.put(kOutOfTheBox, kInTheBox);
  EXPECT_EQ(p.follow(), Regions::changed);
  EXPECT_EQ(p.parts->store[0].region, Region::rest);
  EXPECT_DOUBLE_EQ(p.value(0.5, -2.0), 2.0);
  EXPECT_EQ(p.follow(), Regions::at_rest);
}

TEST(ModeProgram, TellsTheLargestChangeOfAWeight) {
  Programmed p;
  EXPECT_EQ(p.program.assign_regions(p.parts->store, p.parts->verdicts), 0.0);
  p.put(kOutOfTheBox, kOutOfTheBox);
  EXPECT_DOUBLE_EQ(p.program.assign_regions(p.parts->store, p.parts->verdicts), 0.9) << "from 1 to 10";
}

TEST(ModeProgram, OnlyTightensAfterAFewRounds) {
  Programmed p;
  bool over = false;
  const auto cross = [&] {
    over = !over;
    p.put(over ? kOutOfTheBox : kInTheBox, kOutOfTheBox);
    return p.follow();
  };
  for (std::uint32_t k = 0; k < tuning::kFreeRegionRounds; ++k) EXPECT_EQ(cross(), Regions::changed) << k;
  EXPECT_EQ(cross(), Regions::changed) << "back into the tighter region";
  EXPECT_EQ(p.parts->store[0].region, Region::leading_edge);
  EXPECT_EQ(cross(), Regions::at_rest) << "from where it does not come back";
  EXPECT_EQ(p.parts->store[0].region, Region::leading_edge);
  p.program.restart();
  EXPECT_EQ(p.follow(), Regions::changed) << "another refinement is free again";
}

/// Between two zones of which each is the tighter one on one side, that is the limit of either.
TEST(ModeProgram, KeepsTheTighterLimitOnEitherSide) {
  LocalizerConfig config = program_config(FitMode::min_tolerance, RegionPolicy::follow, 0.1);
  ToleranceMap& map = config.tolerance;
  map.boxes[0].zone = 1;
  map.zones[0] = {Region::leading_edge, false, 0.0, std::numeric_limits<double>::infinity(), 0.1, 0.4};
  map.zones[1] = {Region::rest, true, 0.0, std::numeric_limits<double>::infinity(), 0.4, 0.1};
  map.zone_count = 2;
  map.transition = 0;
  Programmed p(config);
  EXPECT_DOUBLE_EQ(p.value(0.2, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(p.value(-0.2, 0.0), 0.5);
  bool over = false;
  for (std::uint32_t k = 0; k <= tuning::kFreeRegionRounds; ++k) {
    over = !over;
    p.put(over ? kOutOfTheBox : kInTheBox, kOutOfTheBox);
    EXPECT_EQ(p.follow(), Regions::changed) << k;
  }
  for (const double u : {kInTheBox, kOutOfTheBox}) {
    p.put(u, kOutOfTheBox);
    EXPECT_EQ(p.follow(), Regions::at_rest);
    EXPECT_DOUBLE_EQ(p.value(0.2, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(p.value(-0.2, 0.0), 2.0);
  }
}

TEST(ModeProgram, GivesUpRegionsThatNeverRest) {
  Programmed p;
  Regions regions = Regions::changed;
  std::uint32_t rounds = 0;
  for (double u = 0.95; regions == Regions::changed; u -= 0.01, ++rounds) {  // tighter and tighter
    ASSERT_GT(u, 0.61);
    p.put(kInTheBox, u);
    regions = p.follow();
  }
  EXPECT_EQ(regions, Regions::restless);
  EXPECT_EQ(rounds, tuning::kRegionRounds);
}

TEST(ModeProgram, ReportsItsValueInMillimetresWithThePointsThatProveIt) {
  Programmed p(FitMode::constrained);
  QuadraticModel model;
  model.gauss = Mat6::Identity();
  DistanceRow row;
  row.gradient = Vec6::Unit(3);
  row.distance = 0.3;
  p.program.set_row(0, row);
  row.gradient = -row.gradient;
  p.program.set_row(1, row);
  (void)p.program.step(model);
  ModeOptimum optimum;
  p.program.report(p.parts->store, optimum);
  EXPECT_DOUBLE_EQ(optimum.value, 0.3) << "three tolerances of 0.1 mm";
  EXPECT_EQ(optimum.certificate.count, 2U);
}

}  // namespace
}  // namespace bladefit::testing
