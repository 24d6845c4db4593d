// R of r/R is that of the surface about its axis, and the zone of a leading edge is where the surface bends.

#include "tools/batch/tip_radius.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/support/compiled_design.hpp"
#include "tests/support/made_surface.hpp"
#include "tools/batch/edge_zone.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {
namespace {

using testing::CompiledDesign;

/// The greatest distance of a dense grid of places.
double greatest(const Surface& surface, const ShaftAxis& axis, int steps) {
  double radius = 0;
  for (std::uint32_t patch = 0; patch < surface.image().patches().size(); ++patch) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps; ++j) {
        const SurfacePlace place =
            surface.place_at(patch, static_cast<double>(i) / steps, static_cast<double>(j) / steps);
        radius = std::max(radius, axis.radius_of(surface.evaluate(place).s));
      }
    }
  }
  return radius;
}

TEST(TipRadius, IsThatOfTheSurfaceAboutAnyAxis) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const NurbsSurface made =
        testing::random_surface({.degree = 3, .spans = 3}, {.degree = 2, .spans = 4}, seed % 2 == 0, seed);
    const CompiledDesign design(write_image({made}, DesignUnit::mm, 1));
    for (const ShaftAxis& axis : {ShaftAxis(), ShaftAxis{Vec3(50, 40, -30), Vec3::UnitZ()},
                                  ShaftAxis{Vec3(10, 0, 5), Vec3(1, 2, 3).normalized()}}) {
      const double radius = tip_radius_of(design.surface(), axis), seen = greatest(design.surface(), axis, 150);
      EXPECT_GE(radius, seen * (1 - 1e-12));
      EXPECT_LE(radius, seen * (1 + 2e-3)) << seed;
    }
  }
}

/// The control points of a blade stand outside its surface.
TEST(TipRadius, IsNotThatOfTheControlPoints) {
  const StudyCase study = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  const Surface surface(study.design);
  EXPECT_NEAR(tip_radius_of(surface, {}), greatest(surface, {}, 400), 1e-3);
  double controls = 0;
  for (const Eigen::Vector3d& point : study.surfaces.front().control_points)
    controls = std::max(controls, ShaftAxis().radius_of(point));
  EXPECT_LT(tip_radius_of(surface, {}), controls);
}

TEST(EdgeZone, WarnsOfTheWrongParameterOnly) {
  const StudyCase dtmb = read_study_case(BLADEFIT_TEST_DATA "/dtmb4119");
  const StudyCase pnsy = read_study_case(BLADEFIT_TEST_DATA "/pnsy_sub");
  const ParameterBox along_u{0, 0.4, 0.6, 0, 1}, along_v{0, 0, 1, 0.4, 0.6};
  EXPECT_EQ(zone_warning(Surface(dtmb.design), along_u), "");
  EXPECT_EQ(zone_warning(Surface(pnsy.design), along_v), "");
  const std::string wrong = zone_warning(Surface(dtmb.design), along_v);
  EXPECT_NE(wrong.find("zone v:0.4:0.6 of patch 0"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("about u 0.5"), std::string::npos) << wrong;
  EXPECT_NE(zone_warning(Surface(pnsy.design), along_u), "");
}

}  // namespace
}  // namespace bladefit
