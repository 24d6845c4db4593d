// Joints between patches: where a neighbour continues the surface a foot is interior, where it bends it is an edge of
// the material and not of the design.

#include <gtest/gtest.h>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/flat_sheets.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

using Kinds = std::array<Joint, 4>;

/// Sixteen parts of one kind.
std::uint64_t all_of(Joint joint) {
  std::uint64_t parts = 0;
  for (std::uint32_t part = 0; part < kJointParts; ++part) parts = with_joint(parts, part, joint);
  return parts;
}

/// The sides of a patch, in the order of kLowU ...: what all spans have in all parts; none where they differ.
Kinds joints_of(const DesignImage& image, std::uint32_t patch) {
  const ImagePatch& p = image.patches()[patch];
  Kinds kinds{};
  for (std::size_t side = 0; side < 4; ++side) {
    bool first = true;
    for (const ImageSpan& s : image.spans()) {
      const std::array<bool, 4> on{s.iu == 0, s.iu + 1 == p.spans_u, s.iv == 0, s.iv + 1 == p.spans_v};
      if (s.patch != patch || !on[side]) continue;
      const Joint joint = joint_of_part(s.joints[side], 0);
      const bool same = s.joints[side] == all_of(joint) && (first || joint == kinds[side]);
      kinds[side] = same ? joint : Joint::none;
      if (!same) break;
      first = false;
    }
  }
  return kinds;
}

/// Outer edges are all alike.
Kinds meeting(Kinds kinds) {
  for (Joint& joint : kinds) joint = is_outer(joint) ? Joint::none : joint;
  return kinds;
}

constexpr Joint kNone = Joint::none, kSmooth = Joint::smooth, kRidge = Joint::ridge, kValley = Joint::valley;

Foot nearest_foot(const CompiledDesign& design, const Vec3& r) {
  const GlobalProjection found = project_global(design.surface(), {r, Vec3::Zero(), 0.0}, nullptr);
  EXPECT_TRUE(found.proven);
  return foot_of(design.surface(), found.nearest, 0.0);
}

void expect_joint(const Foot& foot, double distance) {
  EXPECT_EQ(foot.kind, FootKind::edge);
  EXPECT_EQ(foot.border, FootBorder::joint);
  EXPECT_NEAR(foot.distance, distance, 1e-9);
  EXPECT_EQ(foot.beyond, 0.0);
}

TEST(CoreJoints, AreSmoothWhereOnePatchGoesOnInTheNext) {
  const DesignImage& arl = reference_design("arl_3patch").image();
  EXPECT_EQ(meeting(joints_of(arl, 0)), (Kinds{kNone, kSmooth, kNone, kNone}));
  EXPECT_EQ(meeting(joints_of(arl, 1)), (Kinds{kSmooth, kSmooth, kNone, kNone}));
  EXPECT_EQ(meeting(joints_of(arl, 2)), (Kinds{kSmooth, kNone, kNone, kNone}));
  const DesignImage& pnsy = reference_design("pnsy_3patch").image();
  EXPECT_EQ(meeting(joints_of(pnsy, 1)), (Kinds{kNone, kNone, kSmooth, kSmooth}));
  for (const char* name : {"arl_fan", "dtmb4119", "pnsy_sub"}) {
    for (const ImageSpan& span : reference_design(name).image().spans()) {
      for (const std::uint64_t parts : span.joints) {
        for (std::uint32_t part = 0; part < kJointParts; ++part)
          EXPECT_TRUE(is_outer(joint_of_part(parts, part))) << name;
      }
    }
  }
}

TEST(CoreJoints, AreRidgesWhereTwoSidesMeetInASharpEdge) {
  const CompiledDesign wedge(flat_design({upper_side(), lower_side()}));
  EXPECT_EQ(joints_of(wedge.image(), 0), (Kinds{kRidge, kNone, kNone, kNone}));
  EXPECT_EQ(joints_of(wedge.image(), 1), (Kinds{kNone, kRidge, kNone, kNone}));
  expect_joint(nearest_foot(wedge, {-0.3, 50, 0}), 0.3);
  expect_joint(nearest_foot(wedge, {-0.03, 50, 0.1}), std::hypot(0.03, 0.1));
  expect_joint(nearest_foot(wedge, {-0.03, 50, -0.1}), std::hypot(0.03, 0.1));
}

TEST(CoreJoints, AreFoundAcrossGapsOfSomeHundredths) {
  for (const double gap : {0.01, 0.02, 0.05}) {
    for (const Vec3& way : {Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-0.6, 0, -0.8)}) {
      const CompiledDesign wedge(flat_design({upper_side(), displaced(lower_side(), gap * way)}));
      EXPECT_EQ(joints_of(wedge.image(), 0)[kLowU], kRidge) << gap << " " << way.transpose();
      EXPECT_EQ(joints_of(wedge.image(), 1)[kHighU], kRidge) << gap << " " << way.transpose();
      const Foot foot = nearest_foot(wedge, {-0.3, 50, 0});
      EXPECT_EQ(foot.border, FootBorder::joint);
      EXPECT_NEAR(foot.distance, 0.3, gap);
    }
  }
  const CompiledDesign open(flat_design({upper_side(), displaced(lower_side(), {0, 0, -1})}));
  EXPECT_EQ(meeting(joints_of(open.image(), 0)), Kinds{}) << "a blunt edge";
}

TEST(CoreJoints, DoNotDependOnTheParametersOfThePatches) {
  for (const NurbsSurface& upper :
       {upper_side(), turned_parameters(upper_side()), turned_parameters(turned_parameters(upper_side()))}) {
    for (const NurbsSurface& lower :
         {turned_parameters(lower_side()), turned_parameters(turned_parameters(turned_parameters(lower_side())))}) {
      const CompiledDesign wedge(flat_design({lower, upper}));
      for (const std::uint32_t patch : {0U, 1U}) {
        const Kinds kinds = joints_of(wedge.image(), patch);
        EXPECT_EQ(std::count(kinds.begin(), kinds.end(), kRidge), 1);
        EXPECT_EQ(std::count(kinds.begin(), kinds.end(), kNone), 3);
      }
      expect_joint(nearest_foot(wedge, {-0.3, 20, 0}), 0.3);
    }
  }
}

TEST(CoreJoints, ReachAsFarAlongASideAsPatchesMeet) {
  const NurbsSurface half = flat_sheet({{60, 0, -10}, {0, 0, 0}}, 50.0);
  const CompiledDesign wedge(flat_design({upper_side(), half}));
  const std::uint64_t parts = wedge.image().spans()[0].joints[kLowU];
  for (std::uint32_t part = 0; part < kJointParts; ++part) {
    EXPECT_EQ(joint_of_part(parts, part), part < kJointParts / 2 ? kRidge : kNone) << part;
  }
  expect_joint(nearest_foot(wedge, {-0.3, 20, 0}), 0.3);
  EXPECT_EQ(nearest_foot(wedge, {-0.3, 80, 0}).border, FootBorder::outer);
}

TEST(CoreJoints, AreFoundWhereSeveralPatchesMeetOne) {
  const CompiledDesign wedge(flat_design({upper_side(), flat_sheet({{60, 0, -10}, {0, 0, 0}}, 37.0),
                                          turned_parameters(flat_sheet({{60, 0, -10}, {0, 0, 0}}, 63.0, 37.0))}));
  EXPECT_EQ(joints_of(wedge.image(), 0)[kLowU], kRidge);
  for (const double y : {1.0, 36.9, 37.1, 99.0}) expect_joint(nearest_foot(wedge, {-0.3, y, 0}), 0.3);
}

TEST(CoreJoints, AreValleysWhereTheMaterialIsOnTheOtherSide) {
  const CompiledDesign floor_and_wall(
      flat_design({flat_sheet({{0, 0, 0}, {-50, 0, 0}}), flat_sheet({{0, 0, 50}, {0, 0, 0}})}, -1));
  EXPECT_EQ(joints_of(floor_and_wall.image(), 0)[kLowU], kValley);
  EXPECT_EQ(joints_of(floor_and_wall.image(), 1)[kHighU], kValley);
  expect_joint(nearest_foot(floor_and_wall, {0.2, 50, -0.1}), -std::hypot(0.2, 0.1));
  const Foot foot = nearest_foot(floor_and_wall, {0.2, 50, -0.1});
  EXPECT_LT((foot.normal - Vec3(-2, 0, 1).normalized()).norm(), 1e-9) << "out of the material";
}

TEST(CoreJoints, FollowTheSideOfTheMaterial) {
  for (const int outward : {1, -1}) {
    std::vector<std::byte> image = flat_design({upper_side(), lower_side()}, -outward);
    set_outward(image, outward);
    const CompiledDesign turned_round(image), made_so(flat_design({upper_side(), lower_side()}, outward));
    for (const std::uint32_t patch : {0U, 1U})
      EXPECT_EQ(joints_of(turned_round.image(), patch), joints_of(made_so.image(), patch));
    EXPECT_EQ(joints_of(turned_round.image(), 0)[kLowU], outward > 0 ? kRidge : kValley);
  }
}

TEST(CoreJoints, AreRidgesAtAKnifeEdge) {
  const CompiledDesign knife(flat_design({flat_sheet({{0, 0, 0}, {60, 0, 0}}), flat_sheet({{60, 0, -1}, {0, 0, 0}})}));
  EXPECT_EQ(joints_of(knife.image(), 0)[kLowU], kRidge);
  expect_joint(nearest_foot(knife, {-0.3, 50, 0}), 0.3);
}

TEST(CoreJoints, AreBentWhereTheNormalTurnsByLessThanARightAngle) {
  const CompiledDesign roof(
      flat_design({flat_sheet({{-60, 0, -20}, {0, 0, 0}}), flat_sheet({{0, 0, 0}, {60, 0, -20}})}));
  EXPECT_EQ(joints_of(roof.image(), 0)[kHighU], Joint::bent);
  EXPECT_EQ(joints_of(roof.image(), 1)[kLowU], Joint::bent);
  expect_joint(nearest_foot(roof, {0.01, 50, 0.3}), std::hypot(0.01, 0.3));
  const CompiledDesign gutter(
      flat_design({flat_sheet({{-60, 0, 20}, {0, 0, 0}}), flat_sheet({{0, 0, 0}, {60, 0, 20}})}));
  expect_joint(nearest_foot(gutter, {0.01, 50, -0.3}), -std::hypot(0.01, 0.3));
}

TEST(CoreJoints, AreAtCreasesInsideAPatch) {
  const CompiledDesign nose(flat_design({flat_sheet({{60, 0, -10}, {0, 0, 0}, {60, 0, 10}})}));
  ASSERT_EQ(nose.image().spans().size(), 2U);
  EXPECT_EQ(nose.image().spans()[0].joints[kHighU], all_of(kRidge));
  EXPECT_EQ(nose.image().spans()[1].joints[kLowU], all_of(kRidge));
  EXPECT_EQ(nose.image().spans()[0].joints[kLowU], 0U);
  expect_joint(nearest_foot(nose, {-0.3, 50, 0}), 0.3);
}

TEST(CoreJoints, AreWhereAPatchMeetsItself) {
  const CompiledDesign section(flat_design({flat_sheet({{0, 0, 0}, {30, 0, 8}, {60, 0, 0}, {30, 0, -8}, {0, 0, 0}})}));
  EXPECT_EQ(joints_of(section.image(), 0), (Kinds{kRidge, kRidge, kNone, kNone}));
  expect_joint(nearest_foot(section, {-0.3, 50, 0}), 0.3);
  expect_joint(nearest_foot(section, {60.3, 50, 0}), 0.3);
}

TEST(CoreJoints, AreNotWhereASurfaceIsThereTwice) {
  for (const double off : {0.0, 0.003}) {
    const CompiledDesign twice(flat_design({upper_side(), displaced(upper_side(), {off, off, 0})}));
    for (const std::uint32_t patch : {0U, 1U}) EXPECT_EQ(meeting(joints_of(twice.image(), patch)), Kinds{}) << off;
  }
}

/// A wide seam: half a tenth.
TEST(CoreJoints, AFootInAWideGapBetweenLevelSheetsIsInteriorOnBothSides) {
  const CompiledDesign level(
      flat_design({flat_sheet({{-60, 0, 0}, {0, 0, 0}}), flat_sheet({{0.05, 0, 0}, {60, 0, 0}})}));
  EXPECT_EQ(joints_of(level.image(), 0), (Kinds{kNone, kSmooth, kNone, kNone}));
  for (const double height : {0.3, -0.3, 0.01, -0.01}) {
    for (const double x : {0.01, 0.025, 0.04}) {
      const Foot foot = nearest_foot(level, {x, 50, height});
      EXPECT_EQ(foot.kind, FootKind::interior);
      EXPECT_NEAR(foot.distance, height, 1e-9);
    }
  }
}

TEST(CoreJoints, AreOpenWhereTwoOuterEdgesFaceEachOther) {
  const CompiledDesign blunt(flat_design({upper_side_with_tail(), lower_side_with_tail()}));
  const Joint open = joints_of(blunt.image(), 0)[kHighU];
  EXPECT_TRUE(is_outer(open));
  EXPECT_EQ(lean_of(open), 0.15) << "4 in 30, rounded up";
  EXPECT_EQ(joints_of(blunt.image(), 1)[kLowU], open);
  for (const double z : {-0.9, -0.5, 0.1, 0.5, 0.9}) {
    const Foot foot = nearest_foot(blunt, {60, 50, z});
    EXPECT_EQ(foot.border, FootBorder::outer) << z;
    EXPECT_EQ(foot.beyond, 0.0) << z;
    EXPECT_NEAR(nearest_foot(blunt, {60.3, 50, z}).beyond, 0.3, 0.02) << z;
  }
}

TEST(CoreJoints, AnOuterEdgeTellsHowFarAPointIsBeyondIt) {
  const CompiledDesign wedge(flat_design({upper_side(), lower_side()}));
  const Vec3 along = Vec3(60, 0, 10).normalized(), up = Vec3(-10, 0, 60).normalized(), end(60, 40, 10);
  const Foot back = nearest_foot(wedge, end + 0.4 * along - 0.3 * up);
  EXPECT_EQ(back.kind, FootKind::edge);
  EXPECT_EQ(back.border, FootBorder::outer);
  EXPECT_NEAR(back.distance, 0.5, 1e-9);
  EXPECT_NEAR(back.beyond, 0.4, 1e-9);
  const Foot corner = nearest_foot(wedge, Vec3(60, 100, 10) + 0.4 * along + Vec3(0, 0.7, 0));
  EXPECT_EQ(corner.kind, FootKind::corner);
  EXPECT_EQ(corner.border, FootBorder::outer);
  EXPECT_NEAR(corner.beyond, 0.7, 1e-9);
  const Foot tip = nearest_foot(wedge, {-0.3, 100.4, 0});
  EXPECT_EQ(tip.kind, FootKind::corner);
  EXPECT_EQ(tip.border, FootBorder::joint_end);
  EXPECT_NEAR(tip.distance, 0.5, 1e-9);
  EXPECT_NEAR(tip.beyond, 0.4, 1e-9);
}

/// Points above a seam that has a gap or an overlap of some micrometres.
TEST(CoreJoints, AFootInAGapIsInterior) {
  const CompiledDesign& whole = reference_design("arl_fan");
  const CompiledDesign& parted = reference_design("arl_3patch_gap");
  std::mt19937_64 random(3);
  int held = 0;
  for (int k = 0; k < 400; ++k) {
    const SurfacePlace place = whole.surface().place_at(0, 0.33 + (k % 2) * 0.33, uniform(random, 0.05, 0.95));
    const SurfacePoint at = whole.surface().evaluate(place);
    const double height = uniform(random, -0.5, 0.5);
    const Vec3 r = at.s + height * whole.surface().normal(place, at);
    const GlobalProjection found = project_global(parted.surface(), {r, Vec3::Zero(), 0.0}, nullptr);
    ASSERT_TRUE(found.proven);
    const Foot foot = foot_of(parted.surface(), found.nearest, 0.0);
    if (found.nearest.fixed_u || found.nearest.fixed_v) ++held;
    EXPECT_EQ(foot.kind, FootKind::interior) << k;
    EXPECT_NEAR(foot.distance, height, 2 * kGapMm) << k;
  }
  EXPECT_GT(held, 20);  // the gap is met
}

/// Points that fall into the gap count in a fit that leaves feet on edges out.
TEST(CoreJoints, PointsOnThemCountInTheFit) {
  const CompiledDesign& whole = reference_design("arl_fan");
  const CompiledDesign& parted = reference_design("arl_3patch_gap");
  LocalizerConfig config;
  config.capacity = 300;
  config.use_approach = false;
  OwnedLocalizer localizer(parted.image(), config);
  std::mt19937_64 random(5);
  const Pose moved_by{rotation_of({1e-3, -2e-3, 1e-3}), Vec3(0.1, -0.2, 0.1)};
  for (std::uint32_t k = 1; k <= 300; ++k) {
    const double u = k % 2 == 0 ? 0.33 : uniform(random, 0.05, 0.95);
    const SurfacePoint at = whole.surface().evaluate(whole.surface().place_at(0, u, uniform(random, 0.05, 0.95)));
    ProbePoint point;
    point.sequence = k;
    const Vec3 place = moved_by.rotation.transpose() * (at.s - moved_by.translation);
    std::copy(place.begin(), place.end(), point.position.begin());
    ASSERT_EQ(localizer->stage(point), Status::ok);
  }
  localizer->conclude();
  ASSERT_EQ(refine_fully(*localizer), Status::ok);
  EXPECT_EQ(localizer->fit().rejected, 0U);
  EXPECT_LT(localizer->fit().rms_mm, 4e-3);
}

}  // namespace
}  // namespace bladefit::testing
