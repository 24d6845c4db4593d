// Seams between patches: where a neighbour continues the surface a foot is interior, elsewhere it is on an edge.

#include <gtest/gtest.h>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// Bits of the sides of a patch all of whose spans are seams.
std::uint32_t seams_of(const DesignImage& image, std::uint32_t patch) {
  const ImagePatch& p = image.patches()[patch];
  std::uint32_t all = kSeamAtLowU | kSeamAtHighU | kSeamAtLowV | kSeamAtHighV;
  for (const ImageSpan& s : image.spans()) {
    if (s.patch != patch) continue;
    if (s.iu == 0 && (s.ends & kSeamAtLowU) == 0) all &= ~kSeamAtLowU;
    if (s.iu + 1 == p.spans_u && (s.ends & kSeamAtHighU) == 0) all &= ~kSeamAtHighU;
    if (s.iv == 0 && (s.ends & kSeamAtLowV) == 0) all &= ~kSeamAtLowV;
    if (s.iv + 1 == p.spans_v && (s.ends & kSeamAtHighV) == 0) all &= ~kSeamAtHighV;
  }
  return all;
}

TEST(CoreSeams, AreWhereOnePatchGoesOnInTheNext) {
  const DesignImage& arl = reference_design("arl_3patch").image();
  EXPECT_EQ(seams_of(arl, 0), kSeamAtHighU);
  EXPECT_EQ(seams_of(arl, 1), kSeamAtLowU | kSeamAtHighU);
  EXPECT_EQ(seams_of(arl, 2), kSeamAtLowU);
  const DesignImage& pnsy = reference_design("pnsy_3patch").image();
  EXPECT_EQ(seams_of(pnsy, 1), kSeamAtLowV | kSeamAtHighV);
  for (const char* name : {"arl_fan", "dtmb4119"}) {
    for (const ImageSpan& span : reference_design(name).image().spans()) EXPECT_LT(span.ends, 16U) << name;
  }
}

/// Points above a seam that has a gap or an overlap of some micrometres.
TEST(CoreSeams, AFootInAGapIsInterior) {
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
TEST(CoreSeams, PointsOnThemCountInTheFit) {
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
