// Verdicts are those of the final pose: neither the frame of the machine nor the start of the fit is in them.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/localizer_session.hpp"

namespace bladefit::testing {
namespace {

/// The machine's frame, moved.
std::vector<ProbePoint> in_frame_of(std::vector<ProbePoint> points, const Pose& moved_by) {
  for (ProbePoint& point : points) {
    const Vec3 place = apply(moved_by, Vec3(point.position.data()));
    const Vec3 approach = moved_by.rotation * Vec3(point.approach.data());
    std::copy(place.begin(), place.end(), point.position.begin());
    std::copy(approach.begin(), approach.end(), point.approach.begin());
  }
  return points;
}

/// Every 8th point of the blade; nothing where the fit did not converge.
std::vector<Verdict> verdicts_of(const BladeSession& s, const std::vector<ProbePoint>& points, const Pose& start) {
  LocalizerConfig config = s.config;
  config.start = start;
  OwnedLocalizer localizer(s.design.image(), config);
  for (const ProbePoint& point : points) EXPECT_EQ(localizer->stage(point), Status::ok);
  localizer->conclude();
  if (refine_fully(*localizer) != Status::ok) return {};
  std::vector<Verdict> verdicts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(localizer->verdict_of(points[i].sequence, verdicts[i]), Status::ok);
  return verdicts;
}

void expect_same(const std::vector<Verdict>& a, const std::vector<Verdict>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].state, b[i].state) << what << " " << i;
    EXPECT_EQ(a[i].action, b[i].action) << what << " " << i;
    EXPECT_EQ(a[i].region, b[i].region) << what << " " << i;
    EXPECT_EQ(a[i].fitted, b[i].fitted) << what << " " << i;
    EXPECT_NEAR(a[i].foot.distance, b[i].foot.distance, 1e-7) << what << " " << i;
  }
}

TEST(FinalPoseVerdicts, AreThoseOfTheBladeInEveryFrame) {
  const BladeSession s;
  const std::vector<ProbePoint> points = thinned(s.reference, 0, 8);
  const std::vector<Verdict> straight = verdicts_of(s, points, Pose());
  ASSERT_FALSE(straight.empty());
  std::mt19937_64 random(19);
  const Vec3 about(1, 0, 0);
  for (const double degrees : {120.0, 65.0}) {
    Pose moved_by{rotation_exp(degrees * M_PI / 180.0 * (degrees == 120.0 ? about : random_direction_in_space(random))),
                  Vec3(300, -40, 25)};
    Pose back{moved_by.rotation.transpose(), Vec3::Zero()};
    back.translation = -(back.rotation * moved_by.translation);
    expect_same(verdicts_of(s, in_frame_of(points, moved_by), back), straight, std::to_string(degrees));
  }
}

TEST(FinalPoseVerdicts, AreThoseOfTheBladeFromEveryStartThatLeadsThere) {
  const BladeSession s;
  const std::vector<ProbePoint> points = thinned(s.reference, 0, 8);
  const std::vector<Verdict> near = verdicts_of(s, points, Pose());
  std::mt19937_64 random(23);
  int arrived = 0;
  for (int k = 0; k < 6; ++k) {
    Pose start;
    start.rotation = rotation_exp(uniform(random, 0.0, 0.2) * random_direction_in_space(random));
    start.translation = uniform(random, 0.0, 20.0) * random_direction_in_space(random);
    const std::vector<Verdict> far = verdicts_of(s, points, start);
    if (far.empty() || std::abs(far[0].foot.distance - near[0].foot.distance) > 1e-3) continue;  // another optimum
    ++arrived;
    expect_same(far, near, std::to_string(k));
  }
  EXPECT_GE(arrived, 3);
}

}  // namespace
}  // namespace bladefit::testing
