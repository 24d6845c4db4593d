#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/tools/design_fixtures.hpp"
#include "tests/unit/tools/design_image_reading.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/nurbs/patch_points.hpp"
#include "tools/design/nurbs/surface_samples.hpp"

namespace bladefit {
namespace {

using testing::evaluate_surface;
using testing::open_image;
using testing::random_surface;

Eigen::Vector3d position_of(const ProbePoint& point) { return Eigen::Vector3d(point.position.data()); }
Eigen::Vector3d approach_of(const ProbePoint& point) { return Eigen::Vector3d(point.approach.data()); }

/// Two patches, the second without weights, and the image of both.
struct TwoPatches {
  std::vector<NurbsSurface> surfaces = {random_surface({3, 4}, {2, 3}, true, 5), random_surface({}, {}, false, 6)};
  std::vector<std::byte> bytes = write_image(surfaces, DesignUnit::mm, -1);
  DesignImage design = open_image(bytes);
};

TEST(SurfaceSamples, LieOnAGridOfEachPatch) {
  const TwoPatches two;
  SamplePlan plan;
  plan.count_u = 5;
  plan.count_v = 3;
  plan.low = 0.1;
  plan.high = 0.9;
  const std::vector<ProbePoint> points = sample_surface(two.design, plan);
  ASSERT_EQ(points.size(), 30U);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_EQ(points[k].sequence, k + 1);
    EXPECT_EQ(points[k].path, k / 5 + 1);
    const double u = 0.1 + 0.2 * static_cast<double>(k % 5);
    const double v = 0.1 + 0.4 * static_cast<double>(k / 5 % 3);
    EXPECT_LT((position_of(points[k]) - evaluate_surface(two.surfaces[k / 15], u, v)).norm(), 1e-12);
    EXPECT_EQ(approach_of(points[k]), Eigen::Vector3d::Zero());
  }
  plan.patch = 1;
  plan.lines_along_v = true;
  plan.count_v = 1;
  const std::vector<ProbePoint> column = sample_surface(two.design, plan);
  ASSERT_EQ(column.size(), 5U);
  for (std::size_t k = 0; k < column.size(); ++k) {
    EXPECT_EQ(column[k].path, k + 1);
    const Eigen::Vector3d wanted = evaluate_surface(two.surfaces[1], 0.1 + 0.2 * static_cast<double>(k), 0.5);
    EXPECT_LT((position_of(column[k]) - wanted).norm(), 1e-12);
  }
}

TEST(SurfaceSamples, StandOffAlongTheOutwardNormalAndAreMoved) {
  const TwoPatches two;
  SamplePlan plan;
  plan.count_u = plan.count_v = 4;
  const std::vector<ProbePoint> on_surface = sample_surface(two.design, plan);
  plan.directions = true;
  plan.offset_mm = 0.25;
  plan.pose.rotation = rotation_of({0.1, -0.2, 0.3});
  plan.pose.translation = Vec3(1, 2, 3);
  const std::vector<ProbePoint> moved = sample_surface(two.design, plan);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const Eigen::Vector3d base =
        plan.pose.rotation * position_of(on_surface[k]) + Eigen::Vector3d(plan.pose.translation);
    EXPECT_NEAR(approach_of(moved[k]).norm(), 1, 1e-14);
    EXPECT_LT((position_of(moved[k]) + 0.25 * approach_of(moved[k]) - base).norm(), 1e-12);
  }
  // The sheets lie flat, so that Su x Sv points up; outward is the other side, and the probe comes in from below.
  plan.pose = Pose();
  EXPECT_GT(sample_surface(two.design, plan).front().approach[2], 0);
}

TEST(SurfaceSamples, NoiseIsNormalAndRepeatable) {
  const TwoPatches two;
  SamplePlan plan;
  plan.count_u = plan.count_v = 60;
  const std::vector<ProbePoint> on_surface = sample_surface(two.design, plan);
  plan.noise_mm = 0.01;
  const std::vector<ProbePoint> noisy = sample_surface(two.design, plan);
  double squares = 0;
  double largest = 0;
  for (std::size_t k = 0; k < noisy.size(); ++k) {
    const double distance = (position_of(noisy[k]) - position_of(on_surface[k])).norm();
    squares += distance * distance;
    largest = std::max(largest, distance);
  }
  // 7200 numbers: the deviation of the root mean square is 0.8 % of it.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(noisy.size())), 0.01, 0.0004);
  EXPECT_GT(largest, 0.03);
  EXPECT_LT(largest, 0.06);
  EXPECT_EQ(sample_surface(two.design, plan)[77].position, noisy[77].position);
  plan.seed = 2;
  EXPECT_NE(sample_surface(two.design, plan)[77].position, noisy[77].position);
}

TEST(PatchPoints, AreThoseWithTheirFootInAWindow) {
  const TwoPatches two;
  SamplePlan plan;
  plan.count_u = plan.count_v = 11;
  plan.patch = 1;
  const std::vector<ProbePoint> points = sample_surface(two.design, plan);
  const std::vector<std::size_t> inside = points_inside(two.design, points, {{1, {0.15, 0.35, 0.55, 0.95}}});
  std::vector<std::size_t> wanted;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t i = k % 11;
    const std::size_t j = k / 11;
    if (i >= 2 && i <= 3 && j >= 6 && j <= 9) wanted.push_back(k);
  }
  EXPECT_EQ(inside, wanted);
  EXPECT_TRUE(points_inside(two.design, points, {{0, {0.15, 0.35, 0.55, 0.95}}}).empty());
}

}  // namespace
}  // namespace bladefit
