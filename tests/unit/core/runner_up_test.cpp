// Points that are equally near to two places of the blade: the middle of a thin edge, the inside of a hollow.

#include <gtest/gtest.h>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_session.hpp"
#include "tests/unit/core/brute_force.hpp"

namespace bladefit::testing {
namespace {

constexpr std::uint32_t kBefore = 400, kBetween = 8, kAfter = 200;

bool inside(const Projection& p) { return p.converged && !p.fixed_u && !p.fixed_v; }

/// Points with two nearest places, neither of them on an edge, as a machine in this pose would measure them. They weigh
/// next to nothing.
std::vector<ProbePoint> points_between(const Surface& surface, const Pose& pose, std::uint32_t first_sequence) {
  std::mt19937_64 random(7);
  std::vector<ProbePoint> points;
  while (points.size() < kBetween) {
    const Vec3 place = equally_near_to_two(surface, random);
    const GlobalProjection found =
        project_global(surface, {place, Vec3::Zero(), 1e-3 * surface.half_diagonal()}, nullptr);
    const Projection rival = project_local(surface, place, found.runner_up.place);
    if (found.runner_up.margin >= found.runner_up.margin_to_third || !inside(found.nearest) || !inside(rival)) continue;
    ProbePoint point;
    point.sequence = first_sequence + static_cast<std::uint32_t>(points.size());
    Eigen::Map<Vec3>(point.position.data()) = pose.rotation.transpose() * (place - pose.translation);
    point.weight = 1e-9;
    points.push_back(point);
  }
  return points;
}

/// Their foot may jump with every motion of the pose, so their rows are taken again in every push; a search each time
/// would take a millisecond at a centre of curvature.
TEST(RunnerUp, PointsBetweenTwoFeetAreNotSearchedAgainInEveryPush) {
  const BladeSession s;
  OwnedLocalizer stream(s.design.image(), s.config);
  push_all(*stream, {s.points.begin(), s.points.begin() + kBefore});
  push_all(*stream, points_between(s.design.surface(), stream->fit().pose, kBefore + 1));
  const std::uint32_t searches = stream->fit().searches;
  std::vector<ProbePoint> rest(s.points.begin() + kBefore, s.points.begin() + kBefore + kAfter);
  for (ProbePoint& point : rest) point.sequence += kBetween;
  push_all(*stream, rest);
  const std::uint32_t again = stream->fit().searches - searches;
  std::printf("[ figures  ] %u searches in %u pushes beside %u such points\n", again, kAfter, kBetween);
  EXPECT_LT(again, 2 * kAfter) << "one for every new point, and few others";
}

/// The foot that Newton's method leads to from that of a verdict.
Projection followed(const Surface& surface, const Vec3& r, const Foot& foot) {
  SurfacePlace place{0, foot.u, foot.v};
  while (surface.span(place.span).patch != foot.patch) ++place.span;
  surface.settle(place);
  return project_local(surface, r, place);
}

/// The feet that a stream keeps are those that a search finds. Their poses are older than that of the search by a few
/// pushes, in which a runner-up may have passed; without weighing the two it stays so, for four feet in a hundred.
TEST(RunnerUp, PointsBetweenTwoFeetKeepTheNearest) {
  const BladeSession s;
  const Surface& surface = s.design.surface();
  OwnedLocalizer stream(s.design.image(), s.config);
  push_all(*stream, {s.points.begin(), s.points.begin() + kBefore});
  const std::vector<ProbePoint> between = points_between(surface, stream->fit().pose, kBefore + 1);
  push_all(*stream, between);
  std::uint32_t passed = 0;
  for (std::uint32_t k = 0; k < kAfter; ++k) {
    ProbePoint point = s.points[kBefore + k];
    point.sequence += kBetween;
    const Pose pose = stream->fit().pose;
    push_all(*stream, {point});
    for (const ProbePoint& one : between) {
      Verdict verdict;
      ASSERT_EQ(stream->verdict_of(one.sequence, verdict), Status::ok);
      const Vec3 r = apply(pose, Vec3(one.position.data()));
      const double least = project_global(surface, {r}, nullptr).nearest.offset.norm();
      const double kept = followed(surface, r, verdict.foot).offset.norm();
      passed += kept > least + 1e-9 * s.design.size() ? 1 : 0;
    }
  }
  std::printf("[ figures  ] %u of %u feet had been passed by their runner-up\n", passed, kAfter * kBetween);
  EXPECT_LE(100 * passed, kAfter * kBetween);
}

}  // namespace
}  // namespace bladefit::testing
