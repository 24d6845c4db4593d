// The fit itself: what batch and stream must agree on, and what must not change it.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_session.hpp"

namespace bladefit::testing {
namespace {

/// Points exactly on the design, away from its edges, as a machine in this pose would measure them.
std::vector<ProbePoint> exact_points(const Surface& surface, const Pose& pose, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<ProbePoint> points;
  while (points.size() < count) {
    const SurfacePlace place = random_place(surface, random);
    if (std::min({place.u, 1.0 - place.u, place.v, 1.0 - place.v}) < 0.02) continue;
    const SurfacePoint p = surface.evaluate(place);
    const Vec3 r = pose.rotation.transpose() * (p.s - pose.translation);
    const Vec3 a = -(pose.rotation.transpose() * surface.normal(place, p));
    points.push_back({static_cast<std::uint32_t>(points.size() + 1), 0, {r[0], r[1], r[2]}, {a[0], a[1], a[2]}, 0});
  }
  return points;
}

Pose small_motion(std::mt19937_64& random, const Surface& surface, double share) {
  const ImageHeader& h = surface.image().header();
  Vec3 middle;
  for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (h.box_min[k] + h.box_max[k]);
  Vec6 step;
  step << share * random_direction_in_space(random),
      share * surface.half_diagonal() * random_direction_in_space(random);
  return moved(Pose(), step, middle);
}

class EveryCase : public ::testing::TestWithParam<std::string> {
 protected:
  ReferenceCase case_ = read_case(GetParam());
  const CompiledDesign& design_ = reference_design(GetParam());
};

/// The inverse motion of exact points is found and nothing is left over.
TEST_P(EveryCase, ExactPointsGiveBackTheirMotion) {
  std::mt19937_64 random(90);
  for (int trial = 0; trial < 4; ++trial) {
    const Pose truth = trial == 0 ? Pose() : small_motion(random, design_.surface(), 1e-3);
    LocalizerConfig config = config_of(case_, 300);
    config.probe_radius_mm = 0.0;
    config.use_approach = true;
    const FitReport report =
        batch_fit(design_.image(), config, exact_points(design_.surface(), truth, 300, 77 + random()));
    const Vec6 difference = pose_difference(truth, report.pose);
    EXPECT_LT(difference.head<3>().norm(), 1e-11);
    EXPECT_LT(difference.tail<3>().norm(), 1e-11 * design_.size());
    EXPECT_LT(report.rms_mm, 1e-11 * design_.size());
  }
}

/// The points as another machine would have measured them give the same distances and the pose of that machine.
TEST_P(EveryCase, MotionOfThePointsMovesThePoseOnly) {
  std::mt19937_64 random(91);
  std::vector<ProbePoint> points = points_of(case_, case_.subsets[1]);
  LocalizerConfig config = config_of(case_, points.size());
  const FitReport before = batch_fit(design_.image(), config, points);
  const Pose motion{rotation_exp(0.5 * random_direction_in_space(random)), 100.0 * random_vector(random)};
  for (ProbePoint& point : points) {
    const Vec3 r = apply(motion, Eigen::Map<const Vec3>(point.position.data()));
    const Vec3 a = motion.rotation * Eigen::Map<const Vec3>(point.approach.data());
    for (std::size_t k = 0; k < 3; ++k) {
      point.position[k] = r[static_cast<Eigen::Index>(k)];
      point.approach[k] = a[static_cast<Eigen::Index>(k)];
    }
  }
  config.start = {motion.rotation.transpose(), -(motion.rotation.transpose() * motion.translation)};
  const FitReport after = batch_fit(design_.image(), config, points);
  EXPECT_NEAR(after.rms_mm, before.rms_mm, 1e-11 * design_.size());
  EXPECT_NEAR(after.leading_edge.worst_mm, before.leading_edge.worst_mm, 1e-10 * design_.size());
  const Pose together{after.pose.rotation * motion.rotation,
                      after.pose.rotation * motion.translation + after.pose.translation};
  const Vec6 difference = pose_difference(before.pose, together);
  EXPECT_LT(difference.head<3>().norm(), 1e-10);
  EXPECT_LT(difference.tail<3>().norm(), 1e-10 * design_.size());
}

TEST_P(EveryCase, RefinedStreamEqualsTheBatchFit) {
  for (const ReferenceSubset& subset : case_.subsets) {
    SCOPED_TRACE(subset.name);
    const std::vector<ProbePoint> points = points_of(case_, subset);
    const LocalizerConfig config = config_of(case_, points.size());
    const FitReport batch = batch_fit(design_.image(), config, points);
    OwnedLocalizer stream(design_.image(), config);
    push_all(*stream, points);
    stream->conclude();
    ASSERT_EQ(refine_fully(*stream), Status::ok);
    const FitReport report = stream->fit();
    EXPECT_EQ(report.status, FitStatus::converged);
    const Vec6 difference = pose_difference(batch.pose, report.pose);
    EXPECT_LT(difference.head<3>().norm(), 1e-9);
    EXPECT_LT(difference.tail<3>().norm(), 1e-7);
    EXPECT_EQ(report.fitted, batch.fitted);
    EXPECT_NEAR(report.rms_mm, batch.rms_mm, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, EveryCase, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& one) { return one.param; });

TEST(Stream, RefineInSmallPiecesGivesTheSame) {
  const BladeSession s;
  OwnedLocalizer whole(s.design.image(), s.config), pieces(s.design.image(), s.config);
  push_all(*whole, s.points);
  push_all(*pieces, s.points);
  ASSERT_EQ(refine_fully(*whole), Status::ok);
  Status status = Status::more_work;
  while (status == Status::more_work) status = pieces->refine(7);
  ASSERT_EQ(status, Status::ok);
  EXPECT_TRUE(identical(whole->fit(), pieces->fit()));
}

/// While streaming, push()'s pose is within a tenth of its own uncertainty of the best pose for the points so far.
TEST(Stream, StaysCloseToTheBestPoseOfEveryPrefix) {
  const BladeSession s;
  OwnedLocalizer stream(s.design.image(), s.config), batch(s.design.image(), s.config);
  batch->conclude();
  std::vector<double> distances;
  Verdict verdict;
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    ASSERT_TRUE(succeeded(stream->push(s.points[k], verdict)));
    ASSERT_EQ(batch->stage(s.points[k]), Status::ok);
    const FitReport report = stream->fit();
    if (report.determined < 6 || k % 5 != 0) continue;
    ASSERT_EQ(refine_fully(*batch), Status::ok) << k;
    distances.push_back(in_uncertainties(report.pose, batch->fit()));
    if (k % 500 == 0) {
      const std::vector<ProbePoint> prefix(s.points.begin(), s.points.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      const FitReport fresh = batch_fit(s.design.image(), s.config, prefix);
      EXPECT_LT(pose_difference(fresh.pose, batch->fit().pose).norm(), 1e-7);
    }
  }
  ASSERT_GT(distances.size(), 350U);
  std::sort(distances.begin(), distances.end());
  const auto quantile = [&](double q) {
    return distances[static_cast<std::size_t>(q * static_cast<double>(distances.size() - 1))];
  };
  std::printf(
      "[ figures  ] %zu prefixes: distance from the best pose in standard uncertainties: median %.4f, "
      "p99 %.4f, largest %.4f\n",
      distances.size(), quantile(0.5), quantile(0.99), distances.back());
  EXPECT_LT(quantile(0.99), 0.1);
}

/// Points of a full memory keep counting; the pose stays where all points want it. Points of the leading edge keep
/// their place longest.
TEST(Stream, GoesOnWhenMemoryIsFull) {
  BladeSession s;
  const FitReport all = batch_fit(s.design.image(), s.config, s.points);
  s.config.capacity = 200;
  OwnedLocalizer stream(s.design.image(), s.config);
  Verdict verdict;
  for (const ProbePoint& point : s.points) {
    const Status status = stream->push(point, verdict);
    if (point.sequence <= 200) {
      EXPECT_NE(status, Status::memory_full);
    } else if (verdict.region == Region::rest) {
      EXPECT_EQ(status, Status::memory_full);
    }
    EXPECT_EQ(verdict.sequence, point.sequence);
    // A place is given up only when nobody waits for news of its point.
    while (stream->next_revision(verdict)) {
    }
  }
  const FitReport report = stream->fit();
  EXPECT_TRUE(report.memory_full);
  EXPECT_EQ(report.points, 2000U);
  EXPECT_EQ(report.fitted, all.fitted);
  int kept = 0, kept_leading_edge = 0;
  for (const ProbePoint& point : s.points) {
    if (stream->verdict_of(point.sequence, verdict) != Status::ok) continue;
    EXPECT_EQ(verdict.sequence, point.sequence);
    ++kept;
    kept_leading_edge += verdict.region == Region::leading_edge ? 1 : 0;
  }
  EXPECT_EQ(kept, 200);
  EXPECT_GT(kept_leading_edge, 190) << "of the 424 points of the leading edge";
  const double streaming = in_uncertainties(report.pose, all);
  ASSERT_EQ(refine_fully(*stream), Status::ok);
  const double refined = in_uncertainties(stream->fit().pose, all);
  std::printf(
      "[ figures  ] memory for 200 of 2000 points: %.3f standard uncertainties from the best pose, %.3f after "
      "refining\n",
      streaming, refined);
  EXPECT_LT(streaming, 1.0);
  EXPECT_LT(refined, 1.0);
  ProbePoint next = s.points.back();
  next.sequence = 2001;
  EXPECT_EQ(stream->stage(next), Status::out_of_range);
}

/// Every foot of a fit that its reach does not prove is searched once at its end, and not again while the pose moves by
/// less than searches are exact to.
TEST(Batch, APoseThatHardlyMovedIsNotSearchedAgain) {
  const ReferenceCase c = read_case("arl_fan");
  const CompiledDesign design = without_reach(reference_design("arl_fan"));
  const Surface& surface = design.surface();
  constexpr int kFits = 200;
  int hardly_moved = 0;
  for (int seed = 1; seed <= kFits; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const std::vector<ProbePoint> points = thinned(c, static_cast<std::size_t>(seed % 4), 4);
    const auto all = static_cast<std::uint32_t>(points.size());
    LocalizerConfig config = config_of(c, points.size());
    config.start = small_motion(random, surface, 0.01);
    OwnedLocalizer localizer(design.image(), config);
    for (const ProbePoint& point : points) ASSERT_EQ(localizer->stage(point), Status::ok);
    localizer->conclude();
    Status status = Status::more_work;
    bool searched = false;
    while (status == Status::more_work) {
      const FitReport before = localizer->fit();
      status = localizer->refine(all);
      const std::uint32_t searches = localizer->fit().searches - before.searches;
      if (searched && before.gradient <= 1e-10 * surface.half_diagonal()) {
        EXPECT_EQ(searches, 0U) << "seed " << seed;
        ++hardly_moved;
      }
      searched = searches == all;
    }
    ASSERT_EQ(status, Status::ok) << "seed " << seed;
    const Pose pose = localizer->fit().pose;
    Verdict verdict;
    for (const ProbePoint& point : points) {
      ASSERT_EQ(localizer->verdict_of(point.sequence, verdict), Status::ok);
      const Vec3 approach = config.use_approach ? Vec3(point.approach.data()) : Vec3(Vec3::Zero());
      const ProjectionQuery query{apply(pose, Vec3(point.position.data())), pose.rotation * approach};
      const Projection nearest = project_global(surface, query, nullptr).nearest;
      EXPECT_NEAR(std::abs(verdict.foot.distance), nearest.offset.norm(), 1e-8) << "point " << point.sequence;
    }
  }
  std::printf("[ figures  ] %d of %d fits moved so little after their searches\n", hardly_moved, kFits);
  EXPECT_GT(hardly_moved, 0) << "no fit went through such a sweep";
}

TEST(Stream, SameStreamSameBits) {
  const BladeSession s;
  OwnedLocalizer a(s.design.image(), s.config), b(s.design.image(), s.config);
  Verdict verdict_a, verdict_b;
  for (const ProbePoint& point : s.points) {
    ASSERT_EQ(a->push(point, verdict_a), b->push(point, verdict_b));
    ASSERT_TRUE(identical(verdict_a, verdict_b)) << point.sequence;
  }
  EXPECT_TRUE(identical(a->fit(), b->fit()));
  // After a reset the same localizer does the same again.
  a->reset();
  EXPECT_EQ(a->fit().points, 0U);
  EXPECT_FALSE(a->next_revision(verdict_a));
  EXPECT_EQ(a->verdict_of(1, verdict_a), Status::not_found);
  push_all(*a, s.points);
  EXPECT_TRUE(identical(a->fit(), b->fit()));
}

}  // namespace
}  // namespace bladefit::testing
