// Points that do not belong to their design as they are: each kind is named, no point is judged, and no search goes on
// without a bound.

#include "tools/batch/world_checks.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <numbers>

#include "tests/support/compiled_design.hpp"
#include "tools/batch/batch_fit.hpp"
#include "tools/batch/cpu_clock.hpp"
#include "tools/batch/unit_check.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {
namespace {

using testing::CompiledDesign;

const StudyCase& propeller_blade() {
  static const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  return study;
}

/// The plan of the case with tolerances that its points meet.
FitPlan judging_plan() {
  FitPlan plan = propeller_blade().plan;
  plan.localizer.tolerance.leading_edge_mm = 0.15;
  plan.localizer.tolerance.rest_mm = 0.5;
  return plan;
}

/// The points under an affine map, with their directions.
std::vector<ProbePoint> mapped(std::vector<ProbePoint> points, const Mat3& map, const Vec3& shift,
                               double factor = 1.0) {
  for (ProbePoint& point : points) {
    const Vec3 at = factor * (map * Vec3(point.position.data())) + shift, approach = map * Vec3(point.approach.data());
    std::copy(at.begin(), at.end(), point.position.begin());
    std::copy(approach.begin(), approach.end(), point.approach.begin());
  }
  return points;
}

std::vector<ProbePoint> blade_points() { return read_subset_points(propeller_blade(), "200"); }

Result fitted(const std::vector<ProbePoint>& points, const FitPlan& plan = judging_plan()) {
  return fit_points(propeller_blade().design, plan, points, "points.csv").result;
}

Mat3 turn(double degrees, const Vec3& axis) {
  return rotation_exp(degrees * std::numbers::pi / 180.0 * axis.normalized());
}

void expect_undecided(const Result& result, Reason code, const std::string& word) {
  ASSERT_EQ(result.verdict.reasons.size(), 1U);
  EXPECT_EQ(result.verdict.reasons.front().code, code) << result.verdict.reasons.front().text;
  EXPECT_NE(result.verdict.reasons.front().text.find(word), std::string::npos) << result.verdict.reasons.front().text;
  EXPECT_EQ(exit_code_of(result), 4);
  for (const ResultPoint& point : result.points) {
    EXPECT_NE(point.state, PointState::in);
    EXPECT_NE(point.state, PointState::out);
    EXPECT_EQ(point.action, Action::none);
  }
}

TEST(WorldChecks, SayNothingOfPointsThatBelong) {
  const Result result = fitted(blade_points());
  EXPECT_TRUE(result.verdict.reasons.empty());
  EXPECT_TRUE(result.notes.empty());
}

TEST(WorldChecks, NameTheFactorOfAnotherUnit) {
  const std::vector<std::pair<double, std::string>> factors = {
      {25.4, "25.4 times too large"}, {1 / 25.4, "25.4 times too small"}, {1000, "1000 times too large"}};
  for (const auto& [factor, words] : factors) {
    const double began = thread_cpu_s();
    const Result result = fitted(mapped(blade_points(), Mat3::Identity(), Vec3::Zero(), factor));
    expect_undecided(result, Reason::wrong_units, words);
    EXPECT_NE(result.verdict.reasons.front().text.find("--units"), std::string::npos);
    EXPECT_LT(thread_cpu_s() - began, 10.0);
  }
}

/// Real points of a small part of the blade are no smaller blade.
TEST(WorldChecks, NameTheUnitThatUndoesTheFactor) {
  const auto ends = [](double factor, Unit unit, const std::string& words) {
    return unit_sentence({factor, true}, unit).ends_with(words);
  };
  EXPECT_TRUE(ends(1.0 / 1000.0, Unit::mm, "; give --units m"));
  EXPECT_TRUE(ends(1.0 / 25.4, Unit::mm, "; give --units in"));
  EXPECT_TRUE(ends(25.4, Unit::inch, "; give --units mm"));
  EXPECT_TRUE(ends(100.0, Unit::metre, "; give --units cm"));
  EXPECT_TRUE(ends(25.4, Unit::mm, "or correct the unit of the design"));
}

TEST(WorldChecks, ASmallPartIsNoOtherUnit) {
  std::vector<ProbePoint> points = read_subset_points(propeller_blade(), "full");
  const Vec3 middle(points[700].position.data());
  std::erase_if(points, [&middle](const ProbePoint& p) { return (Vec3(p.position.data()) - middle).norm() > 20.0; });
  ASSERT_TRUE(much_smaller_than_design(Surface(propeller_blade().design), points));
  const Result result = fitted(points);
  EXPECT_TRUE(result.verdict.fit_decided()) << result.verdict.reasons.front().text;
}

TEST(WorldChecks, NameMirroredPoints) {
  for (int axis = 0; axis < 3; axis += 2) {
    Mat3 mirror = Mat3::Identity();
    mirror(axis, axis) = -1.0;
    expect_undecided(fitted(mapped(blade_points(), mirror, Vec3::Zero())), Reason::mirrored, "mirrored");
  }
}

/// However the points are turned and shifted, the verdicts are those of the points where they belong.
TEST(WorldChecks, AFarStartIsSearchedAndTold) {
  const std::vector<ProbePoint> points = blade_points();
  const Result wanted = fitted(points);
  const std::vector<std::pair<Mat3, Vec3>> motions = {
      {turn(120, Vec3::UnitX()), Vec3::Zero()},
      {turn(65, Vec3::UnitX()), Vec3::Zero()},
      {turn(30, Vec3(1, 2, 3)), Vec3(80, 0, 60)},
      {Mat3::Identity(), Vec3(0, 2000, 0)},
  };
  for (const auto& [rotation, shift] : motions) {
    const double began = thread_cpu_s();
    const Result result = fitted(mapped(points, rotation, shift));
    EXPECT_LT(thread_cpu_s() - began, 10.0);
    ASSERT_TRUE(result.verdict.reasons.empty()) << result.verdict.reasons.front().text;
    ASSERT_EQ(result.notes.size(), 1U);
    EXPECT_NE(result.notes.front().find("off"), std::string::npos) << result.notes.front();
    ASSERT_EQ(result.points.size(), wanted.points.size());
    for (std::size_t k = 0; k < wanted.points.size(); ++k) {
      EXPECT_EQ(result.points[k].state, wanted.points[k].state);
      EXPECT_NEAR(result.points[k].distance, wanted.points[k].distance, 1e-6);
    }
  }
}

TEST(WorldChecks, PointsOfAnotherPartAreNotDecided) {
  const StudyCase other = read_study_case(BLADEFIT_TEST_DATA "/pnsy_sub");
  // A blade of another shape, made as large as this one.
  const std::vector<ProbePoint> points =
      mapped(read_subset_points(other, "101"), Mat3::Identity(), Vec3::Zero(), 140.0 / 1900.0);
  expect_undecided(fitted(points), Reason::far_start, "no pose was found");
}

TEST(WorldChecks, DirectionsThatRunOutOfTheMaterialAreNamed) {
  std::vector<ProbePoint> points = blade_points();
  for (ProbePoint& point : points) {
    for (double& x : point.approach) x = -x;
  }
  expect_undecided(fitted(points), Reason::mirrored, "probing direction");
}

TEST(WorldChecks, LockedDegreesOfFreedomAreNotSearched) {
  FitPlan plan = judging_plan();
  plan.localizer.locked = kLockTx;
  const std::vector<ProbePoint> points = mapped(blade_points(), Mat3::Identity(), Vec3(0, 2000, 0));
  expect_undecided(fitted(points, plan), Reason::far_start, "--lock");
}

/// Locks that leave one degree of freedom.
constexpr std::uint8_t kAllButTx = static_cast<std::uint8_t>(kLockAll & ~kLockTx);

/// The blade without its inner part, which its root covers: points there are beyond the edge of the face.
const CompiledDesign& trimmed_blade() {
  static const CompiledDesign design = [] {
    NurbsSurface blade = propeller_blade().surfaces.front();
    const auto radius = [](const Eigen::Vector3d& point) { return std::hypot(point.y(), point.z()); };
    const auto row = static_cast<std::size_t>(blade.v.control_points);
    const double inner = radius(blade.control_points.front());
    const bool along_u = radius(blade.control_points[blade.control_points.size() - row]) - inner > 20.0;
    constexpr double kCut = 0.3;
    blade.trims = {along_u ? TrimLoop{{kCut, 0, true}, {1, 0, true}, {1, 1, true}, {kCut, 1, true}}
                           : TrimLoop{{0, kCut, true}, {1, kCut, true}, {1, 1, true}, {0, 1, true}}};
    return CompiledDesign(write_image({blade}, DesignUnit::mm, propeller_blade().outward));
  }();
  return design;
}

/// A third of the points and more are off the face, the rest lie on it as they should: no other world is looked for
/// among poses that the locked degrees of freedom do not have.
TEST(WorldChecks, PointsBesideATrimmedFaceMirrorNothingWhereTheFrameIsKnown) {
  FitPlan plan = judging_plan();
  plan.localizer.locked = kAllButTx;
  plan.localizer.start = fitted(blade_points()).pose;
  const Result result = fit_points(trimmed_blade().image(), plan, blade_points(), "points.csv").result;
  const auto beside = std::count_if(result.points.begin(), result.points.end(),
                                    [](const ResultPoint& p) { return p.kind != FootKind::interior; });
  EXPECT_GT(4 * static_cast<std::size_t>(beside), result.points.size());
  EXPECT_LT(2 * static_cast<std::size_t>(beside), result.points.size());
  EXPECT_TRUE(result.verdict.fit_decided()) << result.verdict.reasons.front().text;
  for (const ResultPoint& point : result.points) {
    EXPECT_TRUE(point.kind != FootKind::interior || point.state == PointState::in);
  }
}

TEST(WorldChecks, MirroredPointsAreNamedWhereTheFrameIsKnown) {
  FitPlan plan = judging_plan();
  plan.localizer.locked = kAllButTx;
  plan.localizer.start = Pose();
  const Pose pose = fitted(blade_points()).pose;
  for (int axis = 1; axis < 3; ++axis) {
    Mat3 mirror = Mat3::Identity();
    mirror(axis, axis) = -1.0;
    const std::vector<ProbePoint> aligned = mapped(blade_points(), pose.rotation, pose.translation);
    expect_undecided(fitted(mapped(aligned, mirror, Vec3::Zero()), plan), Reason::mirrored, "mirrored");
  }
}

/// Three blades, one a patch.
const CompiledDesign& propeller() {
  static const CompiledDesign design = [] {
    std::vector<NurbsSurface> blades;
    for (int k = 0; k < 3; ++k) {
      NurbsSurface blade = propeller_blade().surfaces.front();
      const Mat3 rotation = turn(120.0 * k, Vec3::UnitX());
      for (Eigen::Vector3d& point : blade.control_points) point = rotation * Vec3(point);
      blades.push_back(blade);
    }
    return CompiledDesign(write_image(blades, DesignUnit::mm, propeller_blade().outward));
  }();
  return design;
}

TEST(WorldChecks, ThePoseChoosesTheBladeOrNobodyDoes) {
  FitPlan plan = judging_plan();
  const std::vector<ProbePoint> points = mapped(blade_points(), turn(120, Vec3::UnitX()), Vec3::Zero());
  const Result near = fit_points(propeller().image(), plan, points, "points.csv").result;
  EXPECT_TRUE(near.verdict.fit_decided());
  ASSERT_EQ(near.notes.size(), 1U);
  for (const char* word : {"fitted to blade 2 (patch 1)", "blade 1 (patch 0)", "blade 3 (patch 2)", "start pose"})
    EXPECT_NE(near.notes.front().find(word), std::string::npos) << word << " in " << near.notes.front();
  plan.search_start = true;
  expect_undecided(fit_points(propeller().image(), plan, points, "points.csv").result, Reason::ambiguous, "blade 3");
}

/// A fit that a session made is only told of.
TEST(WorldChecks, AFitMadeElsewhereIsDoubted) {
  const StudyCase& study = propeller_blade();
  const std::vector<ProbePoint> points = mapped(blade_points(), turn(65, Vec3::UnitX()), Vec3::Zero());
  FitReport report;
  report.status = FitStatus::converged;
  report.determined = 6;
  Rows<JudgedPoint> judged;
  for (const ProbePoint& point : points) {
    Verdict verdict;
    verdict.sequence = point.sequence;
    verdict.state = PointState::in;
    judged.push_back({point, verdict});
  }
  const Result result = result_of(study.design, judging_plan(), judged, report, {}, "session");
  expect_undecided(result, Reason::far_start, "--start");
}

}  // namespace
}  // namespace bladefit
