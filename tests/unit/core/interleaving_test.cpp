// Calls in an order that no session of one run makes: nothing of an earlier call may be left over for a later one.
#include <gtest/gtest.h>

#include "tests/support/localizer_session.hpp"

namespace bladefit::testing {
namespace {

/// A mode's session over thinned points of dtmb4119.
struct ThinSession {
  ReferenceCase reference = read_case("dtmb4119");
  const CompiledDesign& design = reference_design("dtmb4119");
  std::vector<ProbePoint> points;
  LocalizerConfig config;

  explicit ThinSession(FitMode mode, std::size_t stride = 10)
      : points(thinned(reference, 0, stride)), config(config_of(reference, points.size())) {
    config.mode = mode;
    config.tolerance.leading_edge_mm = 0.06;
    config.tolerance.rest_mm = 0.6;
  }
};

void push_some(Localizer& localizer, const std::vector<ProbePoint>& points, std::size_t first, std::size_t end) {
  Verdict verdict;
  for (std::size_t i = first; i < end; ++i) ASSERT_TRUE(succeeded(localizer.push(points[i], verdict)));
}

/// The sweeps of further starts fill no sums; a push after or amid them goes on from those in use.
TEST(CoreInterleaving, APushAfterOrAmidFurtherStartsKeepsEveryPoint) {
  const ThinSession s(FitMode::minimax);
  const std::size_t most = s.points.size() - 20;
  for (const std::uint32_t visits : {0U, 2500U, 2777U, 3100U}) {
    OwnedLocalizer stream(s.design.image(), s.config);
    push_some(*stream, s.points, 0, most);
    stream->conclude();
    if (visits == 0) {
      ASSERT_EQ(refine_fully(*stream), Status::ok);
    } else {
      ASSERT_EQ(stream->refine(visits), Status::more_work);
    }
    const Pose before = stream->fit().pose;
    for (std::size_t i = most; i < s.points.size(); ++i) {
      push_some(*stream, s.points, i, i + 1);
      const FitReport report = stream->fit();
      ASSERT_EQ(report.fitted, i + 1) << visits;
      ASSERT_EQ(report.determined, 6U) << visits;
      ASSERT_LT(pose_difference(before, report.pose).norm(), 0.1) << visits;
    }
  }
}

/// refine() at the end of a path, then conclude(): the order of the C header's example.
TEST(CoreInterleaving, FurtherStartsAreMadeAlsoWhereTheOptimumIsKnownAlready) {
  const ThinSession s(FitMode::min_tolerance);
  OwnedLocalizer stream(s.design.image(), s.config);
  push_some(*stream, s.points, 0, s.points.size());
  ASSERT_EQ(refine_fully(*stream), Status::ok);
  EXPECT_EQ(stream->fit().further_starts, 0U);
  stream->conclude();
  ASSERT_EQ(refine_fully(*stream), Status::ok);
  EXPECT_EQ(stream->fit().further_starts, 12U);
  stream->conclude();
  EXPECT_EQ(stream->refine(1), Status::ok) << "nothing has changed since";
}

/// Points on a small spot determine three directions; a concluded fit uses the weak ones too.
TEST(CoreInterleaving, ThePushAfterAConclusionTakesItBack) {
  const ThinSession s(FitMode::least_squares, 1);
  const Vec3 middle(s.points[1000].position.data());
  std::vector<ProbePoint> spot;
  for (const ProbePoint& point : s.points) {
    if ((Vec3(point.position.data()) - middle).norm() < 18.0) spot.push_back(point);
  }
  ASSERT_GT(spot.size(), 40U);
  OwnedLocalizer stream(s.design.image(), s.config);
  push_some(*stream, spot, 0, spot.size() - 1);
  const std::uint32_t determined = stream->fit().determined;
  ASSERT_LT(determined, 6U);
  stream->conclude();
  ASSERT_EQ(refine_fully(*stream), Status::ok);
  EXPECT_EQ(stream->fit().determined, 6U);
  push_some(*stream, spot, spot.size() - 1, spot.size());
  EXPECT_LT(stream->fit().determined, 6U);
}

TEST(CoreInterleaving, AResetLocalizerHasTheBitsOfANewOne) {
  for (const FitMode mode : {FitMode::least_squares, FitMode::minimax, FitMode::min_tolerance, FitMode::constrained}) {
    ThinSession s(mode, 20);
    s.config.capacity = 30;
    OwnedLocalizer used(s.design.image(), s.config), fresh(s.design.image(), s.config);
    push_some(*used, s.points, 0, s.points.size());
    used->reset();
    Verdict again, first;
    for (const ProbePoint& point : s.points) {
      ASSERT_EQ(used->push(point, again), fresh->push(point, first));
      ASSERT_TRUE(identical(again, first)) << point.sequence;
    }
    EXPECT_TRUE(identical(used->fit(), fresh->fit()));
  }
}

/// Points that wait for the end of a sweep to be taken again in every push are in no sums of that sweep.
TEST(CoreInterleaving, PointsStagedBetweenPushesLeaveNoneOut) {
  for (const char* name : {"arl_fan", "dtmb4119", "pnsy_sub"}) {
    const ReferenceCase c = read_case(name);
    const CompiledDesign& design = reference_design(name);
    const std::vector<ProbePoint> points = thinned(c, 0, 5);
    LocalizerConfig config = config_of(c, points.size());
    config.edges = EdgePolicy::use;
    OwnedLocalizer stream(design.image(), config);
    std::mt19937_64 random(386);
    std::uint32_t expected = 0;
    for (const ProbePoint& point : points) {
      Verdict verdict;
      if (random() % 20 == 0) {
        ASSERT_EQ(stream->stage(point), Status::ok);
      } else {
        ASSERT_TRUE(succeeded(stream->push(point, verdict)));
      }
      ASSERT_EQ(stream->fit().fitted, ++expected) << name;
    }
  }
}

}  // namespace
}  // namespace bladefit::testing
