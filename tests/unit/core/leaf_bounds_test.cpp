// The bounds of the leaves of every design of tests/data, refuted by samples where they can be; creases.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/nearest/leaf_bounds.hpp"
#include "tests/support/localizer_fixtures.hpp"
#include "tools/design/image/image_writer.hpp"

namespace bladefit::testing {
namespace {

class LeafBounds : public ::testing::TestWithParam<std::string> {};

/// The surface at (s, t) of the leaf, with derivatives in these.
SurfacePoint at(const Surface& surface, const ImageLeaf& leaf, double s, double t) {
  const SpanDomain d = surface.domain(leaf.span);
  const LocalRect rect = rect_of(leaf);
  const double across_u = (rect.s_max - rect.s_min) * (d.u_max - d.u_min);
  const double across_v = (rect.t_max - rect.t_min) * (d.v_max - d.v_min);
  const double u = d.u_min + (rect.s_min + s * (rect.s_max - rect.s_min)) * (d.u_max - d.u_min);
  const double v = d.v_min + (rect.t_min + t * (rect.t_max - rect.t_min)) * (d.v_max - d.v_min);
  return scaled(surface.evaluate({leaf.span, u, v}), across_u, across_v);
}

Vec3 vector_of(const float (&x)[3]) { return {x[0], x[1], x[2]}; }

/// The derivatives s, t, aa, ab, bb of 1/2 |r - S|^2 there.
std::array<double, 5> derivatives(const Surface& surface, const ImageLeaf& leaf, const Vec3& r, double s, double t) {
  const SurfacePoint p = at(surface, leaf, s, t);
  const Vec3 e = p.s - r;
  const double ss = p.s_u.squaredNorm() + e.dot(p.s_uu), st = p.s_u.dot(p.s_v) + e.dot(p.s_uv),
               tt = p.s_v.squaredNorm() + e.dot(p.s_vv);
  const Vec3 stretch = vector_of(leaf.bounds.stretch);
  const double alpha = stretch[0], beta = stretch[1], gamma = stretch[2];
  return {e.dot(p.s_u), e.dot(p.s_v), alpha * alpha * ss, alpha * beta * st + alpha * gamma * ss,
          beta * beta * tt + 2.0 * beta * gamma * st + gamma * gamma * ss};
}

/// Slopes of 1/2 |r - S|^2 across the sides of constant s and of constant t.
std::array<double, 2> slopes(const ImageLeaf& leaf, const SurfacePoint& middle, const std::array<double, 5>& found) {
  const Vec3 across = middle.s_u - middle.s_u.dot(middle.s_v) / middle.s_v.squaredNorm() * middle.s_v;
  const double along_t = -middle.s_u.dot(middle.s_v) / middle.s_v.squaredNorm();
  const Vec3 stretch = vector_of(leaf.bounds.stretch);
  return {(found[0] + along_t * found[1]) / across.norm(), stretch[1] * found[1] + stretch[2] * found[0]};
}

void check_leaf(const Surface& surface, const ImageLeaf& leaf, const Vec3& r, std::mt19937_64& random) {
  const Vec3 w = in_frame(leaf.bounds, r);
  const DerivativeRanges ranges = derivative_ranges(leaf.bounds, w);
  const double least = least_distance(leaf.bounds, w);
  const std::array<ValueRange, 5> expected{ranges.u, ranges.v, ranges.uu, ranges.uv, ranges.vv};
  const SurfacePoint middle = at(surface, leaf, 0.5, 0.5);
  std::array<bool, 2> rises{true, true}, falls{true, true};
  for (int k = 0; k < 20; ++k) {
    // Corners and sides, where bounds are reached, come up often.
    const auto parameter = [&] { return std::clamp(uniform(random, -0.3, 1.3), 0.0, 1.0); };
    const double s = parameter(), t = parameter();
    const std::array<double, 5> found = derivatives(surface, leaf, r, s, t);
    const Vec3 stretch = vector_of(leaf.bounds.stretch);
    const double k_t = stretch[2] / stretch[0];
    const double along_t = found[4] - 2.0 * k_t * found[3] + k_t * k_t * found[2];
    const ValueRange tt = ranges_along_t(leaf.bounds, ranges).vv;
    RC_ASSERT(along_t >= tt.least - 1e-10 * (std::abs(tt.least) + std::abs(tt.most)));
    RC_ASSERT(along_t <= tt.most + 1e-10 * (std::abs(tt.least) + std::abs(tt.most)));
    for (std::size_t i = 0; i < 2; ++i) {
      const double slope = slopes(leaf, middle, found)[i];
      rises[i] = rises[i] && slope > 0.0;
      falls[i] = falls[i] && slope < 0.0;
      RC_ASSERT(!(expected[i].least > 0.0 && found[i] <= 0.0));
      RC_ASSERT(!(expected[i].most < 0.0 && found[i] >= 0.0));
    }
    for (std::size_t i = 2; i < 5; ++i) {
      const double rounding = 1e-10 * (std::abs(expected[i].least) + std::abs(expected[i].most));
      RC_ASSERT(found[i] >= expected[i].least - rounding);
      RC_ASSERT(found[i] <= expected[i].most + rounding);
    }
    RC_ASSERT((r - at(surface, leaf, s, t).s).norm() >= least * (1.0 - 1e-12) - 1e-12);
  }
  if (slopes_across(leaf.bounds, w)) RC_ASSERT(rises[0] || falls[0] || rises[1] || falls[1]);
}

TEST_P(LeafBounds, HoldEverySample) {
  const CompiledDesign& design = reference_design(GetParam());
  const auto leaves = design.image().leaves();
  EXPECT_TRUE(rc::check(GetParam() + ": bounds hold", [&] {
    std::mt19937_64 random(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>()));
    const ImageLeaf& leaf = leaves[random() % leaves.size()];
    const double off = design.size() * std::exp2(-uniform(random, 0, 20));
    check_leaf(design.surface(), leaf, vector_of(leaf.bounds.middle) + off * random_direction_in_space(random), random);
  }));
}

/// What the slopes are for: leaves of other spans whose boxes are nearer than the foot.
TEST_P(LeafBounds, SlopesRuleOutLeavesBesideAFoot) {
  const CompiledDesign& design = reference_design(GetParam());
  const auto leaves = design.image().leaves();
  std::mt19937_64 random(8);
  int beside = 0, left = 0;
  for (int k = 0; k < 1000; ++k) {
    const SurfacePlace place = random_place(design.surface(), random);
    const SurfacePoint p = design.surface().evaluate(place);
    const double off = uniform(random, 0, 3e-3) * design.size();
    const Vec3 r = p.s + off * design.surface().normal(place, p);
    for (const ImageLeaf& leaf : leaves) {
      const Vec3 w = in_frame(leaf.bounds, r);
      if (leaf.span == place.span || least_distance(leaf.bounds, w) >= off) continue;
      ++beside;
      left += slopes_across(leaf.bounds, w) ? 0 : 1;
    }
  }
  RecordProperty("left_share", std::to_string(static_cast<double>(left) / beside));
  EXPECT_GT(beside, 100);
  EXPECT_LT(left, beside * 9 / 10);
}

/// What they are for: a point near the surface is told by bounds alone, nearly always.
TEST_P(LeafBounds, SufficeForPointsNearTheSurface) {
  const CompiledDesign& design = reference_design(GetParam());
  std::mt19937_64 random(7);
  int cut = 0;
  constexpr int kTried = 2000;
  for (int k = 0; k < kTried; ++k) {
    const SurfacePlace place = random_place(design.surface(), random);
    const SurfacePoint at = design.surface().evaluate(place);
    const Vec3 r = at.s + uniform(random, 0, 1e-3) * design.size() * design.surface().normal(place, at);
    cut += project_global(design.surface(), {r, Vec3::Zero(), 0.0}, nullptr).pieces > 0 ? 1 : 0;
  }
  RecordProperty("cut_share", std::to_string(static_cast<double>(cut) / kTried));
  EXPECT_LT(cut, kTried / 4) << "searches that had to cut leaves";
}

INSTANTIATE_TEST_SUITE_P(Designs, LeafBounds, ::testing::Values("arl_fan", "dtmb4119", "pnsy_sub"),
                         [](const auto& parameter) { return parameter.param; });

/// A roof of two planes that meet at a ridge above y = 0, as one patch of degree 1 or, with a double knot, 2.
NurbsSurface roof(int degree) {
  NurbsSurface surface;
  surface.name = "roof";
  const int points = 2 * degree + 1;
  surface.u = {degree, points, {}, 0, 1};
  for (int k = 0; k <= degree; ++k) surface.u.knots.push_back(0);
  for (int k = 0; k < degree; ++k) surface.u.knots.push_back(0.5);
  for (int k = 0; k <= degree; ++k) surface.u.knots.push_back(1);
  surface.v = {1, 2, {0, 0, 1, 1}, 0, 1};
  for (int i = 0; i < points; ++i) {
    const double y = 10.0 * (i - degree) / degree;
    for (int j = 0; j < 2; ++j) surface.control_points.emplace_back(20.0 * j, y, -std::abs(y));
  }
  surface.weights.assign(surface.control_points.size(), 1.0);
  return surface;
}

TEST(Creases, TheRidgeIsTheNearestOfAPointAboveIt) {
  for (const int degree : {1, 2, 3}) {
    const CompiledDesign design(write_image({roof(degree)}, DesignUnit::mm, -1));  // material below
    const Vec3 r(7, 0.5, 3);
    const GlobalProjection found = project_global(design.surface(), {r, Vec3::Zero(), 1.0}, nullptr);
    EXPECT_TRUE(found.proven);
    EXPECT_NEAR((found.nearest.at.s - Vec3(7, 0, 0)).norm(), 0.0, 1e-9) << "degree " << degree;
    const Foot foot = foot_of(design.surface(), found.nearest, 0.0);
    EXPECT_EQ(foot.kind, FootKind::edge);
    EXPECT_NEAR(foot.distance, std::sqrt(9.25), 1e-9);
  }
}

/// Newton's method does not end on a ridge, so the foot is searched in every sweep; it is the same foot.
TEST(Creases, AFitWithAPointAboveTheRidgeComesToRest) {
  const CompiledDesign design(write_image({roof(3)}, DesignUnit::mm, 1));
  std::mt19937_64 random(12);
  LocalizerConfig config;
  config.capacity = 100;
  for (const EdgePolicy edges : {EdgePolicy::skip, EdgePolicy::use}) {
    config.edges = edges;
    OwnedLocalizer localizer(design.image(), config);
    ProbePoint point;
    for (std::uint32_t i = 1; i <= 60; ++i) {
      const double y = uniform(random, 1, 9) * (i % 2 == 0 ? 1 : -1);
      point.sequence = i;
      point.position = {uniform(random, 2, 18), y, -std::abs(y) + uniform(random, 0.01, 0.03)};
      ASSERT_EQ(localizer->stage(point), Status::ok);
    }
    point.sequence = 61;
    point.position = {7, 0.5, 3};
    ASSERT_EQ(localizer->stage(point), Status::ok);
    localizer->conclude();
    EXPECT_EQ(refine_fully(*localizer), Status::underdetermined) << "along the ridge";
  }
}

TEST(Creases, ASmoothKnotIsNone) {
  NurbsSurface flat = roof(3);
  for (Eigen::Vector3d& point : flat.control_points) point.z() = 0;
  const CompiledDesign design(write_image({flat}, DesignUnit::mm, 1));
  const GlobalProjection found = project_global(design.surface(), {Vec3(7, 0, 3), Vec3::Zero(), 1.0}, nullptr);
  EXPECT_TRUE(found.proven);
  EXPECT_EQ(foot_of(design.surface(), found.nearest, 0.0).kind, FootKind::interior);
  EXPECT_NEAR((found.nearest.at.s - Vec3(7, 0, 0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace bladefit::testing
