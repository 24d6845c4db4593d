// What is fitted to what, and which points can be taken in.

#include <gtest/gtest.h>

#include <limits>

#include "core/localizer/fit_problem.hpp"
#include "core/localizer/tuning.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

LocalizerConfig moved_start() {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 10);
  config.start = {rotation_of({0.02, -0.03, 0.01}), {500.0, -200.0, 300.0}};
  return config;
}

FitProblem problem_of(const LocalizerConfig& config) { return {reference_design("dtmb4119").image(), config}; }

/// Where the machine has what the start pose takes to this place of the design.
Vec3 machine_place(const FitProblem& problem, const Vec3& design_place) {
  const Pose& start = problem.config.start;
  return start.rotation.transpose() * (design_place - start.translation);
}

ProbePoint point_at(const Vec3& position) {
  ProbePoint point;
  point.sequence = 1;
  point.position = {position[0], position[1], position[2]};
  point.approach = {0.0, 0.0, 1.0};
  return point;
}

struct Refusal {
  const char* what;
  Status status;
  void (*spoil)(ProbePoint&);
};

constexpr Refusal kRefusals[] = {
    {"x is not a number", Status::not_finite, [](ProbePoint& p) { p.position[0] = kNoNumber; }},
    {"y is not a number", Status::not_finite, [](ProbePoint& p) { p.position[1] = kNoNumber; }},
    {"z is infinite", Status::not_finite, [](ProbePoint& p) { p.position[2] = -kInfinite; }},
    {"i is not a number", Status::not_finite, [](ProbePoint& p) { p.approach[0] = kNoNumber; }},
    {"j is infinite", Status::not_finite, [](ProbePoint& p) { p.approach[1] = kInfinite; }},
    {"k is not a number", Status::not_finite, [](ProbePoint& p) { p.approach[2] = kNoNumber; }},
    {"the weight is not a number", Status::not_finite, [](ProbePoint& p) { p.weight = kNoNumber; }},
    {"the weight is infinite", Status::not_finite, [](ProbePoint& p) { p.weight = kInfinite; }},
    {"the weight is 0", Status::out_of_range, [](ProbePoint& p) { p.weight = 0.0; }},
    {"the weight is negative", Status::out_of_range, [](ProbePoint& p) { p.weight = -1.0; }},
    {"the sequence is 0", Status::out_of_range, [](ProbePoint& p) { p.sequence = 0; }},
    {"the approach is too long", Status::out_of_range,
     [](ProbePoint& p) {
       p.approach = {0.0, 0.0, 1.002};
     }},
    {"the approach is too short", Status::out_of_range,
     [](ProbePoint& p) {
       p.approach = {0.0, 0.998, 0.0};
     }},
};

TEST(FitProblem, RefusesAPointThatIsSpoiledInOneField) {
  const FitProblem problem = problem_of(moved_start());
  const ProbePoint good = point_at(machine_place(problem, problem.surface.middle()));
  ASSERT_EQ(problem.check(good), Status::ok);
  for (const Refusal& refusal : kRefusals) {
    ProbePoint point = good;
    refusal.spoil(point);
    EXPECT_EQ(problem.check(point), refusal.status) << refusal.what;
  }
}

TEST(FitProblem, TakesAnApproachThatIsUnknownOrRounded) {
  const FitProblem problem = problem_of(moved_start());
  ProbePoint point = point_at(machine_place(problem, problem.surface.middle()));
  for (const double length : {0.0, 0.9995, 1.0005}) {
    point.approach = {length, 0.0, 0.0};
    EXPECT_EQ(problem.check(point), Status::ok) << length;
  }
}

TEST(FitProblem, RefusesAPointFarFromTheBladeAtItsStartPose) {
  const FitProblem problem = problem_of(moved_start());
  const double farthest = tuning::kFarthestPoint * problem.surface.half_diagonal();
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
    const Vec3 middle = problem.surface.middle();
    EXPECT_EQ(problem.check(point_at(machine_place(problem, middle + 0.9999 * farthest * way))), Status::ok);
    EXPECT_EQ(problem.check(point_at(machine_place(problem, middle + 1.0001 * farthest * way))), Status::out_of_range);
  }
}

TEST(FitProblem, MeasuresMotionsAboutTheMiddleOfTheDesign) {
  const FitProblem problem = problem_of(moved_start());
  EXPECT_EQ(problem.frame.pivot, problem.surface.middle());
  EXPECT_EQ(problem.frame.length, problem.surface.half_diagonal());
  EXPECT_EQ(problem.reach(), tuning::kLongestStep * problem.surface.half_diagonal());
}

TEST(FitProblem, FillsInWhatCountsAsDetermined) {
  LocalizerConfig config = moved_start();
  EXPECT_EQ(problem_of(config).config.determined_mm, 1e-3 * reference_design("dtmb4119").size());
  config.determined_mm = 0.7;
  EXPECT_EQ(problem_of(config).config.determined_mm, 0.7);
}

TEST(FitProblem, MovesAPoseButHoldsWhatIsLocked) {
  LocalizerConfig config = moved_start();
  const Vec6 step = (Vec6() << 0.1, -0.2, 0.3, -0.1, 0.2, 0.4).finished();
  const FitProblem free = problem_of(config);
  const Pose plain = moved(config.start, step, free.frame), same = free.moved_and_held(config.start, step);
  EXPECT_LT((plain.rotation - same.rotation).norm() + (plain.translation - same.translation).norm(), 1e-12);
  config.locked = kLockTz | kLockRy;
  const FitProblem locked = problem_of(config);
  const Pose held = locked.moved_and_held(plain, step);  // from a pose that has left them
  EXPECT_EQ(held.translation.z(), config.start.translation.z());
  EXPECT_NEAR(euler_angles(held.rotation).theta, euler_angles(config.start.rotation).theta, 1e-15);
  EXPECT_GT(std::abs(held.translation.x() - config.start.translation.x()), 0.01);
}

TEST(FitProblem, KnowsThePlacesOfItsDesign) {
  const FitProblem problem = problem_of(moved_start());
  const auto spans = static_cast<std::uint32_t>(problem.surface.image().spans().size());
  EXPECT_TRUE(problem.on_design({spans - 1, 0.0, 1.0}));
  EXPECT_FALSE(problem.on_design({spans, 0.5, 0.5}));
  for (const double outside : {-1e-9, 1.0 + 1e-9, kNoNumber}) {
    EXPECT_FALSE(problem.on_design({0, outside, 0.5})) << outside;
    EXPECT_FALSE(problem.on_design({0, 0.5, outside})) << outside;
  }
}

TEST(FitProblem, KnowsRegionAndToleranceOfAFoot) {
  LocalizerConfig config = moved_start();
  config.tolerance.leading_edge_mm = 0.02;
  config.tolerance.rest_mm = 0.3;
  const FitProblem problem = problem_of(config);
  Foot foot;
  foot.u = 0.5;
  EXPECT_EQ(problem.region_of(foot), Region::leading_edge);
  EXPECT_EQ(problem.tolerance_of(foot, {Region::leading_edge}), 0.02);
  foot.u = 0.1;
  EXPECT_EQ(problem.region_of(foot), Region::rest);
  EXPECT_EQ(problem.tolerance_of(foot, {Region::rest}), 0.3);
}

}  // namespace
}  // namespace bladefit::testing
