// The modes beside least squares have several optima: the best of several starts is kept.
#include <gtest/gtest.h>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

constexpr FitMode kModes[] = {FitMode::minimax, FitMode::range, FitMode::min_tolerance};

LocalizerConfig config_for(const ReferenceCase& c, std::size_t points, FitMode mode) {
  LocalizerConfig config = config_of(c, points);
  config.mode = mode;
  config.regions = RegionPolicy::fixed;
  return config;
}

/// All points are in, and no more come.
class Batch : public OwnedLocalizer {
 public:
  Batch(const CompiledDesign& design, const LocalizerConfig& config, const std::vector<ProbePoint>& points)
      : OwnedLocalizer(design.image(), config) {
    for (const ProbePoint& point : points) EXPECT_EQ((*this)->stage(point), Status::ok);
    (*this)->conclude();
  }
};

/// Value of the mode at the pose of the report, by global searches for the feet of the points that count.
double value_at(const Localizer& localizer, const CompiledDesign& design, const LocalizerConfig& config,
                const std::vector<ProbePoint>& points) {
  const Pose pose = localizer.fit().pose;
  double least = std::numeric_limits<double>::infinity(), most = -least, ratio = 0;
  for (const ProbePoint& point : points) {
    Verdict verdict;
    EXPECT_EQ(localizer.verdict_of(point.sequence, verdict), Status::ok);
    if (!verdict.fitted) continue;
    ProjectionQuery query{apply(pose, Vec3(point.position.data())), Vec3::Zero(), 0.0};
    if (config.use_approach) query.approach = pose.rotation * Vec3(point.approach.data());
    const Projection nearest = project_global(design.surface(), query, nullptr).nearest;
    const double d = foot_of(design.surface(), nearest, config.probe_radius_mm).distance;
    least = std::min(least, d);
    most = std::max(most, d);
    const bool plain = config.mode == FitMode::minimax || verdict.region == Region::leading_edge;
    ratio = std::max(ratio, std::abs(d) / (plain ? 1.0 : config.ratio));
  }
  return config.mode == FitMode::range ? most - least : ratio;
}

TEST(CoreFurtherStarts, FindNoWorseOptimaAndSometimesBetterOnes) {
  const ReferenceCase c = read_case("arl_fan");
  const CompiledDesign& design = reference_design("arl_fan");
  int better = 0;
  for (std::size_t first = 0; first < 12; ++first) {
    const std::vector<ProbePoint> points = thinned(c, 3 * first, 45);
    for (const FitMode mode : kModes) {
      LocalizerConfig config = config_for(c, points.size(), mode);
      config.further_starts = 0;
      const Batch plain(design, config, points);
      ASSERT_EQ(refine_fully(*plain), Status::ok);
      EXPECT_EQ(plain->fit().further_starts, 0U);
      config.further_starts = 12;
      const Batch sought(design, config, points);
      ASSERT_EQ(refine_fully(*sought), Status::ok);
      const FitReport report = sought->fit();
      EXPECT_EQ(report.further_starts, 12U);
      EXPECT_LE(report.same_optimum, 12U);
      const double value = report.mode_value_mm;
      EXPECT_NEAR(value_at(*sought, design, config, points), value, 1e-9);
      EXPECT_LE(value, plain->fit().mode_value_mm * (1 + 1e-9));
      if (value < plain->fit().mode_value_mm * (1 - 1e-6)) ++better;
    }
  }
  EXPECT_GT(better, 0);
}

bool same_pose(const Pose& a, const Pose& b) { return a.rotation == b.rotation && a.translation == b.translation; }

void expect_same_verdicts(const Localizer& a, const Localizer& b, const std::vector<ProbePoint>& points) {
  Verdict of_a, of_b;
  for (const ProbePoint& point : points) {
    ASSERT_EQ(a.verdict_of(point.sequence, of_a), Status::ok);
    ASSERT_EQ(b.verdict_of(point.sequence, of_b), Status::ok);
    ASSERT_EQ(of_a.foot.distance, of_b.foot.distance);
  }
}

/// No point is moved farther than 0.05 mm from where the other pose puts it.
void expect_near(const Pose& a, const Pose& b, const std::vector<ProbePoint>& points) {
  for (const ProbePoint& point : points) {
    const Vec3 x(point.position.data());
    ASSERT_LT((apply(a, x) - apply(b, x)).norm(), 0.05);
  }
}

/// While they are under way nothing is told of them, and a point that comes after all ends them.
TEST(CoreFurtherStarts, LeavePoseAndVerdictsAloneAndEndWhenAPointComes) {
  constexpr int kLastSweep = 100, kFurtherStarts = 100;  // steps of ten points
  const ReferenceCase c = read_case("dtmb4119");
  const CompiledDesign& design = reference_design("dtmb4119");
  std::vector<ProbePoint> points = thinned(c, 0, 10);
  const ProbePoint last = points.back();
  points.pop_back();
  const LocalizerConfig config = config_for(c, points.size() + 1, FitMode::minimax);
  LocalizerConfig without = config;
  without.further_starts = 0;
  const Batch plain(design, without, points);
  ASSERT_EQ(refine_fully(*plain), Status::ok);
  const Pose optimum = plain->fit().pose;

  const Batch sought(design, config, points);
  while (!same_pose(sought->fit().pose, optimum)) ASSERT_EQ(sought->refine(10), Status::more_work);
  for (int step = 0; step < kLastSweep; ++step) {
    ASSERT_EQ(sought->refine(10), Status::more_work);
    ASSERT_TRUE(same_pose(sought->fit().pose, optimum));
  }
  for (int step = 0; step < kFurtherStarts; ++step) {
    ASSERT_EQ(sought->refine(10), Status::more_work);
    ASSERT_TRUE(same_pose(sought->fit().pose, optimum));
    expect_same_verdicts(*sought, *plain, points);
  }

  Verdict verdict;
  EXPECT_EQ(sought->push(last, verdict), Status::ok);
  expect_near(sought->fit().pose, optimum, points);
  sought->conclude();
  ASSERT_EQ(refine_fully(*sought), Status::ok);
  points.push_back(last);
  const Batch batch(design, config, points);
  ASSERT_EQ(refine_fully(*batch), Status::ok);
  EXPECT_NEAR(sought->fit().mode_value_mm, batch->fit().mode_value_mm, 1e-9);
}

}  // namespace
}  // namespace bladefit::testing
