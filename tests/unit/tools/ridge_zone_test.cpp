// The ridges of a blade are where its sections bend most, on whatever patches they lie, and a zone about one reaches as
// far along the sections as was asked.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "tests/support/compiled_design.hpp"
#include "tests/support/reference_design.hpp"
#include "tools/batch/auto_zone.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/ridge/ridge_zone.hpp"

namespace bladefit {
namespace {

using testing::CompiledDesign;

constexpr double kHalfLength = 50, kHalfWidth = 5, kSpan = 100;
/// Of the ellipse over the 45 degrees of its normal about the end of the major axis.
constexpr double kMeanRadius = 0.5416;

/// An elliptic cylinder along z, in one closed patch: u around it from the end of the minor axis, v along it. Its
/// middle is at `x` and `y`.
NurbsSurface elliptic_cylinder(double x, double y) {
  NurbsSurface surface;
  surface.name = "cylinder";
  surface.u = {2, 9, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}, 0, 1};
  surface.v = {1, 2, {0, 0, 1, 1}, 0, 1};
  constexpr double kSquare[9][2] = {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}};
  for (int i = 0; i < 9; ++i) {
    for (const double z : {0.0, kSpan}) {
      surface.control_points.emplace_back(x + kHalfLength * kSquare[i][0], y + kHalfWidth * kSquare[i][1], z);
      surface.weights.push_back(i % 2 == 0 ? 1.0 : std::numbers::sqrt2 / 2);
    }
  }
  return surface;
}

std::unique_ptr<CompiledDesign> compiled(const std::vector<NurbsSurface>& surfaces) {
  return std::make_unique<CompiledDesign>(write_image(surfaces, DesignUnit::mm, 1));
}

/// Length of the ellipse from the end of its major axis to the point whose x is so far from that end.
double ellipse_arc(double from_end) {
  constexpr int kSteps = 100000;
  const double last = std::acos(1 - from_end / kHalfLength);
  double length = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double angle = last * (k + 0.5) / kSteps;
    length += std::hypot(kHalfLength * std::sin(angle), kHalfWidth * std::cos(angle)) * last / kSteps;
  }
  return length;
}

TEST(BladeRidges, AreTheEndsOfAnEllipse) {
  const auto design = compiled({elliptic_cylinder(7, 80)});
  const auto blades = find_ridges(design->surface(), 9);
  ASSERT_EQ(blades.size(), 1U);
  ASSERT_EQ(blades[0].count, 2U);
  EXPECT_TRUE(blades[0].start.along_u);
  double sides = 0;
  for (std::size_t ridge = 0; ridge < 2; ++ridge) {
    const SectionRidge& middle = blades[0].middle_of(ridge);
    EXPECT_NEAR(std::abs(middle.place.point.x() - 7), kHalfLength, 2e-3);
    EXPECT_NEAR(middle.place.point.y(), 80, 0.01);
    // Over 45 degrees the mean radius is a little more than that of the end, b^2 / a: by numerical integration 0.5416.
    EXPECT_NEAR(middle.radius_mm, kMeanRadius, 2e-3);
    EXPECT_NEAR(blades[0].length_of(ridge), kSpan, 1e-3);
    sides += middle.place.point.x() - 7;
  }
  EXPECT_NEAR(sides, 0, 2e-3);
}

TEST(BladeRidges, AreTheSameOnADesignThatIsCutInPatches) {
  const auto& whole = testing::reference_design("arl_fan").surface();
  const auto& cut = testing::reference_design("arl_3patch").surface();
  const auto one = find_ridges(whole, 17), three = find_ridges(cut, 17);
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(three.size(), 1U);
  ASSERT_EQ(one[0].count, 1U);
  ASSERT_EQ(three[0].count, 1U);
  EXPECT_EQ(three[0].middle_of(0).place.patch, 1U);
  for (std::size_t k = 0; k < 17; ++k) {
    ASSERT_TRUE(one[0].sections[k].ridges[0] && three[0].sections[k].ridges[0]) << k;
    const Vec3 off = one[0].sections[k].ridges[0]->place.point - three[0].sections[k].ridges[0]->place.point;
    EXPECT_LT(off.norm(), 0.05) << k;  // of a nose with a radius of 2 mm
  }
}

TEST(RidgeZone, ReachesAsFarAsAskedOnBothSides) {
  const auto design = compiled({elliptic_cylinder(0, 80)});
  const auto blades = find_ridges(design->surface(), 33);
  ASSERT_EQ(blades.size(), 1U);
  const RidgeZone zone = ridge_zone(design->surface(), blades[0], 0, {6, false}, 64);
  ASSERT_EQ(zone.boxes.size(), 1U);  // a cylinder is the same all along
  const ParameterBox& box = zone.boxes[0];
  EXPECT_EQ(box.v_min, 0);
  EXPECT_EQ(box.v_max, 1);
  for (const double u : {box.u_min, box.u_max}) {
    const Vec3 limit = design->surface().evaluate(design->surface().place_at(0, u, 0.5)).s;
    EXPECT_NEAR(ellipse_arc(kHalfLength - std::abs(limit.x())), 6, 5e-3);
  }
  const RidgeZone share = ridge_zone(design->surface(), blades[0], 0, {6, true}, 64);
  EXPECT_NEAR(share.most_reach_mm, 6, 1e-3);  // of a chord of 100 mm
  EXPECT_NEAR(share.boxes[0].u_min, box.u_min, 1e-5);
}

/// Along each section of a twisted and tapered blade the limits of the boxes are where the zone's are, within the error
/// that is told.
TEST(RidgeZone, BoxesHoldTheLimitsWithinTheErrorTold) {
  const auto& surface = testing::reference_design("dtmb4119").surface();
  const auto blades = find_ridges(surface, 513);
  ASSERT_EQ(blades.size(), 1U);
  const RidgeZone zone = ridge_zone(surface, blades[0], 0, {5, false}, 96);
  EXPECT_LE(zone.boxes.size(), 96U);
  EXPECT_LT(zone.error_mm, 0.1);
  for (const ParameterBox& box : zone.boxes) {
    for (const double v : {box.v_min + 1e-9, 0.5 * (box.v_min + box.v_max), box.v_max - 1e-9}) {
      const SectionLine line = section_line(PatchEdges(surface), {0, true, v});
      const auto ridges = section_ridges(surface, line, 45);
      ASSERT_FALSE(ridges.empty()) << v;
      for (const double side : {-5.0, 5.0}) {
        const SectionPoint limit = place_on(surface, line, ridges[0].place.arc + side);
        const double u = side < 0 ? box.u_min : box.u_max;
        const Vec3 held = surface.evaluate(surface.place_at(0, u, v)).s;
        EXPECT_NEAR((held - limit.point).norm(), 0, zone.error_mm + 0.01) << v << " " << side;
      }
    }
  }
}

/// The zone on the cut design is the same part of the blade, on as many patches as it needs.
TEST(RidgeZone, GoesOnAcrossJoints) {
  const auto& cut = testing::reference_design("arl_3patch").surface();
  const auto blades = find_ridges(cut, 65);
  ASSERT_EQ(blades.size(), 1U);
  const RidgeZone zone = ridge_zone(cut, blades[0], 0, {70, false}, 96);
  bool on[3] = {false, false, false};
  for (const ParameterBox& box : zone.boxes) {
    on[box.patch] = true;
    EXPECT_TRUE(box.patch == 0 || box.u_min == 0);
    EXPECT_TRUE(box.patch == 2 || box.u_max == 1);
  }
  EXPECT_TRUE(on[0] && on[1] && on[2]);
}

FitSettings settings_of(const std::string& zone) {
  EdgeZone read;
  EXPECT_FALSE(parse_edge_zone(zone, read));
  FitSettings settings;
  settings.leading_edge = {read};
  return settings;
}

std::string refusal_of(const FitSettings& settings, const DesignImage& design) {
  try {
    static_cast<void>(plan_fit(settings, design));
  } catch (const ToolError& error) {
    return error.what();
  }
  return "";
}

TEST(AutoZone, AsksWhichOfTwoRidgesUnlessItIsTold) {
  const auto design = compiled({elliptic_cylinder(0, 80)});
  FitSettings settings = settings_of("auto:6mm");
  const std::string refusal = refusal_of(settings, design->image());
  EXPECT_NE(refusal.find("(50,80,50 mm)"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("(-50,80,50 mm)"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("--leading-edge-near"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find('\n'), std::string::npos);

  const auto middle_x = [&design](const FitPlan& plan) {
    const ParameterBox& box = plan.localizer.tolerance.boxes[0];
    return design->surface().evaluate(design->surface().place_at(0, 0.5 * (box.u_min + box.u_max), 0.5)).s.x();
  };
  settings.leading_edge_near = Vec3(-30, 0, 0);
  EXPECT_LT(middle_x(plan_fit(settings, design->image())), 0);
  settings.leading_edge_near = Vec3(30, 0, 0);
  const FitPlan near = plan_fit(settings, design->image());
  EXPECT_GT(middle_x(near), 0);
  EXPECT_EQ(near.localizer.tolerance.box_count, 1U);
  EXPECT_EQ(near.localizer.tolerance.boxes[0].zone, 1U);
  EXPECT_NE(near.note.find("its zone: 6 mm"), std::string::npos) << near.note;
  // About z a right-handed turn takes what is at y = 80 towards -x.
  settings.leading_edge_near.reset();
  settings.axis = ShaftAxis{Vec3::Zero(), Vec3::UnitZ()};
  settings.rotation = Rotation::right;
  EXPECT_LT(middle_x(plan_fit(settings, design->image())), 0);
  settings.rotation = Rotation::left;
  EXPECT_GT(middle_x(plan_fit(settings, design->image())), 0);
}

TEST(AutoZone, SaysWhyThereIsNone) {
  NurbsSurface sheet = elliptic_cylinder(0, 0);
  sheet.u.start = 0.3;  // from a little before the end of the major axis: half of the ellipse and no end of it
  sheet.u.end = 0.7;
  const auto flat = compiled({sheet});
  EXPECT_NE(refusal_of(settings_of("auto:3%"), flat->image()).find("no edge is found"), std::string::npos);
  FitSettings boxed = settings_of("u:0.4:0.6");
  boxed.rotation = Rotation::left;
  EXPECT_EQ(refusal_of(boxed, flat->image()), "--rotation: only for --leading-edge auto:5mm or auto:3%; leave it out");
}

TEST(AutoZone, IsWrittenWithItsUnit) {
  EdgeZone zone;
  ASSERT_FALSE(parse_edge_zone("auto:0.2in", zone));
  EXPECT_NEAR(zone.reach, 5.08, 1e-12);
  ASSERT_FALSE(parse_edge_zone("auto:3%", zone));
  EXPECT_TRUE(zone.percent);
  EXPECT_EQ(zone.reach, 3);
  for (const char* wrong : {"auto:", "auto:5", "auto:mm", "auto:-5mm", "auto:0mm", "auto:5 mm", "auto:50%", "auto:5km"})
    EXPECT_NE(parse_edge_zone(wrong, zone).message.find("is not a zone; write auto:"), std::string::npos) << wrong;
  EXPECT_EQ(zone.reach, 3);
}

}  // namespace
}  // namespace bladefit
