// The reach of every span, refuted by touching balls where it can be; what it saves, and that it changes no answer.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/geometry/nearest/reach.hpp"
#include "tests/support/localizer_session.hpp"
#include "tests/support/made_surface.hpp"
#include "tests/support/touching_balls.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/image/reach.hpp"

namespace bladefit::testing {
namespace {

/// The image of surfaces in mm, outward where the normal looks, with its reach.
std::vector<std::byte> reaching(const std::vector<NurbsSurface>& surfaces) {
  std::vector<std::byte> image = write_image(surfaces, DesignUnit::mm, 1);
  mark_reach(image);
  return image;
}

class Reach : public ::testing::TestWithParam<std::string> {};

TEST_P(Reach, BallsWithinItHoldNoOtherPoint) {
  const std::uint64_t seed = std::random_device()();
  const TouchingBalls balls = touching_balls(reference_design(GetParam()).surface(), balls_asked(3000), seed);
  std::printf("[ figures  ] %s, seed %llu: %zu of %zu balls\n", GetParam().c_str(),
              static_cast<unsigned long long>(seed), balls.tested, balls.tried);
  EXPECT_EQ(balls.held, 0U) << "seed " << seed << ": " << balls.first;
  EXPECT_EQ(balls.rivals, 0U) << "seed " << seed << ": " << balls.first;
  EXPECT_GT(balls.tested_share(), 0.7);
}

INSTANTIATE_TEST_SUITE_P(Of, Reach,
                         ::testing::Values("arl_fan", "arl_3patch", "arl_3patch_gap", "dtmb4119", "pnsy_sub",
                                           "pnsy_3patch"));

RC_GTEST_PROP(ReachOfRandomSheets, BallsWithinItHoldNoOtherPoint, ()) {
  const bool rational = *rc::gen::arbitrary<bool>(), creased = *rc::gen::arbitrary<bool>();
  const int degree_u = *rc::gen::inRange(1, 6), degree_v = *rc::gen::inRange(1, 6);
  const auto seed = *rc::gen::noShrink(rc::gen::arbitrary<std::uint32_t>());
  const DirectionPlan plan_u{degree_u, *rc::gen::inRange(1, 4), true, false, creased}, plan_v{degree_v, 2};
  const CompiledDesign design(reaching({random_surface(plan_u, plan_v, rational, seed)}));
  const TouchingBalls balls = touching_balls(design.surface(), 200, seed);
  RC_LOG() << balls.first;
  RC_ASSERT(balls.held == 0U);
  RC_ASSERT(balls.rivals == 0U);
}

/// Two sheets, one above the other: half the way between them, and nothing that is in the way on the outer sides.
TEST(ReachOfSheets, IsNoMoreThanHalfTheWayToTheNext) {
  NurbsSurface low = random_surface({1, 3}, {1, 3}, false, 1);
  for (Eigen::Vector3d& point : low.control_points) point[2] = 0.0;
  NurbsSurface high = low;
  for (Eigen::Vector3d& point : high.control_points) point[2] = 4.0;
  const CompiledDesign design(reaching({low, high}));
  for (const ImageSpan& span : design.image().spans()) {
    const std::size_t between = span.patch == 0 ? 0 : 1;
    EXPECT_LE(span.reach[between], 2.0F);
    EXPECT_GT(span.reach[between], 1.0F);
    EXPECT_GT(span.reach[1 - between], 5.0F);
  }
}

/// All that a stream and a refinement after it say, and how many searches that took.
struct Session {
  std::vector<Verdict> verdicts;
  FitReport streamed, refined;
};
Session session_on(const DesignImage& image, const ReferenceCase& c, FitMode mode) {
  const std::vector<ProbePoint> points = points_of(c, "full");
  LocalizerConfig config = config_of(c, points.size());
  config.mode = mode;
  OwnedLocalizer localizer(image, config);
  Session out;
  for (const ProbePoint& point : points) EXPECT_TRUE(succeeded(localizer->push(point, out.verdicts.emplace_back())));
  out.streamed = localizer->fit();
  localizer->conclude();
  EXPECT_TRUE(succeeded(refine_fully(*localizer)));
  out.refined = localizer->fit();
  return out;
}

class ReachInAFit : public ::testing::TestWithParam<std::tuple<const char*, FitMode>> {};

TEST_P(ReachInAFit, SavesSearchesAndChangesNoBit) {
  const auto [name, mode] = GetParam();
  const ReferenceCase c = read_case(name);
  const CompiledDesign& design = reference_design(name);
  Session with = session_on(design.image(), c, mode);
  const Session none = session_on(without_reach(design).image(), c, mode);
  std::printf("[ figures  ] searches, stream %u of %u, all %u of %u\n", with.streamed.searches, none.streamed.searches,
              with.refined.searches, none.refined.searches);
  EXPECT_LT(2 * with.refined.searches, none.refined.searches);
  with.streamed.searches = none.streamed.searches;
  with.refined.searches = none.refined.searches;
  EXPECT_TRUE(identical(with.streamed, none.streamed));
  EXPECT_TRUE(identical(with.refined, none.refined));
  ASSERT_EQ(with.verdicts.size(), none.verdicts.size());
  for (std::size_t k = 0; k < none.verdicts.size(); ++k)
    ASSERT_TRUE(identical(with.verdicts[k], none.verdicts[k])) << k;
}

INSTANTIATE_TEST_SUITE_P(Of, ReachInAFit,
                         ::testing::Combine(::testing::Values("arl_fan", "dtmb4119", "pnsy_3patch"),
                                            ::testing::Values(FitMode::least_squares, FitMode::min_tolerance)));

TEST(ImageIdentity, IsTheSameWithoutReach) {
  const CompiledDesign& design = reference_design("dtmb4119");
  const CompiledDesign none = without_reach(design);
  EXPECT_NE(none.image().header().crc32, design.image().header().crc32);
  EXPECT_EQ(none.image().identity(), design.image().identity());
  EXPECT_EQ(none.image().identity(), none.image().header().crc32);
  EXPECT_NE(reference_design("arl_fan").image().identity(), design.image().identity());
}

/// A foot at a hand's breadth is told of, one beyond the reach, one at the side of a span and one without reach are
/// not.
TEST(ProofByReach, IsOfWhatLiesWithinReachAlone) {
  const CompiledDesign& design = reference_design("dtmb4119");
  const Surface& surface = design.surface();
  std::uint32_t index = 0;
  while (!(surface.span(index).reach[0] > 1.0F && surface.span(index).reach[1] > 0.0F)) ++index;
  const ImageSpan& span = surface.span(index);
  const SpanDomain d = surface.domain(index);
  Projection foot;
  foot.place = {index, 0.5 * (d.u_min + d.u_max), 0.5 * (d.v_min + d.v_max)};
  foot.at = surface.evaluate(foot.place);
  const Vec3 normal = foot.at.s_u.cross(foot.at.s_v).normalized();
  const auto proof_at = [&](double off) {
    foot.offset = off * normal;
    return proof_by_reach(surface, foot);
  };
  for (const std::size_t side : {0U, 1U}) {
    const double reach = (side == 0 ? 1.0 : -1.0) * static_cast<double>(span.reach[side]);
    EXPECT_TRUE(proof_at(0.999 * reach).nearest);
    EXPECT_FALSE(proof_at(1.001 * reach).nearest);
    EXPECT_LT(proof_at(0.5 * reach).margin, proof_at(0.1 * reach).margin);
  }
  EXPECT_NEAR(proof_at(0.0).margin, static_cast<double>(span.apart), 1e-12);
  foot.place.u = d.u_max;
  EXPECT_FALSE(proof_at(0.1).nearest);
  const CompiledDesign none = without_reach(design);
  foot.place.u = 0.5 * (d.u_min + d.u_max);
  EXPECT_FALSE(proof_by_reach(none.surface(), foot).nearest);
}

}  // namespace
}  // namespace bladefit::testing
