// The pose of points is found from nothing but the points, from whatever way they are turned, or not at all.

#include "tools/search/pose_search.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <random>

#include "tools/reproduce/study_case.hpp"
#include "tools/search/even_rotations.hpp"

namespace bladefit {
namespace {

Pose random_pose(std::mt19937_64& random, double length) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  q.normalize();
  return {Mat3(q.toRotationMatrix()), length * Vec3(normal(random), normal(random), normal(random))};
}

/// The points as another machine frame has them.
std::vector<ProbePoint> moved_points(std::vector<ProbePoint> points, const Pose& pose) {
  for (ProbePoint& point : points) {
    const Vec3 at = apply(pose, Vec3(point.position.data())), approach = pose.rotation * Vec3(point.approach.data());
    std::copy(at.begin(), at.end(), point.position.begin());
    std::copy(approach.begin(), approach.end(), point.approach.begin());
  }
  return points;
}

/// The pose that undoes `pose`.
Pose inverse(const Pose& pose) {
  const Mat3 back = pose.rotation.transpose();
  return {back, -(back * pose.translation)};
}

class PoseSearchOf : public ::testing::TestWithParam<const char*> {};

TEST_P(PoseSearchOf, FindsEveryTurnedPoseAgain) {
  const StudyCase study = read_study_case(std::string(BLADEFIT_TEST_DATA "/") + GetParam());
  const std::vector<ProbePoint> points = read_subset_points(study, "full");
  const PoseSearch search(study.design, study.plan.localizer);
  const double length = search.samples().half_diagonal_mm;
  std::mt19937_64 random(20);
  for (int k = 0; k < 2; ++k) {
    const Pose away = random_pose(random, 2.0 * length);
    const std::vector<ProbePoint> turned = moved_points(points, away);
    const std::vector<PoseFit> found = search.poses_of(turned);
    ASSERT_FALSE(found.empty());
    // As measured the points are within some thousandths of the design.
    EXPECT_LT(apart(turned, found.front().pose, inverse(away)), 0.01 * length) << GetParam() << " " << k;
    EXPECT_LT(found.front().typical_mm, 0.005 * length);
    for (std::size_t other = 1; other < found.size(); ++other) EXPECT_GT(found[other].typical_mm, 0.01 * length);
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, PoseSearchOf, ::testing::Values("dtmb4119", "dtmb4119_ball", "arl_fan", "pnsy_sub"),
                         [](const auto& one) { return std::string(one.param); });

/// Points of a tenth of a blade.
TEST(PoseSearch, FindsAPartOfABlade) {
  const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  std::vector<ProbePoint> points = read_subset_points(study, "full");
  const Vec3 middle(points[points.size() / 3].position.data());
  std::erase_if(points, [&middle](const ProbePoint& p) { return (Vec3(p.position.data()) - middle).norm() > 25.0; });
  ASSERT_GT(points.size(), 100U);
  std::mt19937_64 random(21);
  const Pose away = random_pose(random, 500.0);
  const std::vector<PoseFit> found =
      PoseSearch(study.design, study.plan.localizer).poses_of(moved_points(points, away));
  ASSERT_FALSE(found.empty());
  EXPECT_LT(apart(moved_points(points, away), found.front().pose, inverse(away)), 1.0);
}

/// The same points give the same bits.
TEST(PoseSearch, IsRepeatable) {
  const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/arl_fan");
  const std::vector<ProbePoint> points = read_subset_points(study, "106");
  const PoseSearch search(study.design, study.plan.localizer);
  const std::vector<PoseFit> first = search.poses_of(points), second = search.poses_of(points);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].pose.rotation, second[k].pose.rotation);
    EXPECT_EQ(first[k].pose.translation, second[k].pose.translation);
  }
}

TEST(PoseSearch, CountsDirectionsThatRunOutOfTheMaterial) {
  const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  std::vector<ProbePoint> points = read_subset_points(study, "200");
  const PoseSearch search(study.design, study.plan.localizer);
  EXPECT_FALSE(search.poses_of(points).front().is_averted());
  for (ProbePoint& point : points) {
    for (double& x : point.approach) x = -x;
  }
  EXPECT_TRUE(search.poses_of(points).front().is_averted());
}

TEST(PoseSearch, FewerThanSixPointsHaveNone) {
  const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  std::vector<ProbePoint> points = read_subset_points(study, "050");
  points.resize(5);
  EXPECT_TRUE(PoseSearch(study.design, study.plan.localizer).poses_of(points).empty());
}

TEST(EvenRotations, LeaveNoGap) {
  const std::vector<Mat3> rotations = even_rotations(600);
  std::mt19937_64 random(22);
  for (int k = 0; k < 200; ++k) {
    const Mat3 wanted = random_pose(random, 1.0).rotation;
    double nearest = 10;
    for (const Mat3& rotation : rotations)
      nearest = std::min(nearest, rotation_log(rotation * wanted.transpose()).norm());
    EXPECT_LT(nearest, 0.6);
  }
  for (const Mat3& rotation : rotations) {
    EXPECT_LT((rotation.transpose() * rotation - Mat3::Identity()).norm(), 1e-14);
    EXPECT_GT(rotation.determinant(), 0.0);
  }
}

}  // namespace
}  // namespace bladefit
