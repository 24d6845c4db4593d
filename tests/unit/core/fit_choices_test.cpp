// What a fit may be asked for beside its mode: locked degrees of freedom, weights, robust losses, a start far away.

#include <gtest/gtest.h>

#include <cmath>

#include "core/fit/motion_lock.hpp"
#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

struct Fit {
  Status status;
  FitReport report;
};

Fit fit(const std::string& name, const std::vector<ProbePoint>& points, LocalizerConfig config) {
  config.capacity = static_cast<std::uint32_t>(points.size());
  OwnedLocalizer localizer(reference_design(name).image(), config);
  for (const ProbePoint& point : points) EXPECT_EQ(localizer->stage(point), Status::ok);
  localizer->conclude();
  const Status status = refine_fully(*localizer);
  return {status, localizer->fit()};
}

/// Pose of the parameters tx, ty, tz, psi, theta, phi.
Pose pose_of(const std::array<double, 6>& p) { return {rotation_of({p[3], p[4], p[5]}), Vec3(p[0], p[1], p[2])}; }

std::array<double, 6> parameters_of(const Pose& pose) {
  const EulerAngles e = euler_angles(pose.rotation);
  return {pose.translation[0], pose.translation[1], pose.translation[2], e.psi, e.theta, e.phi};
}

/// Sum of squared distances by global searches.
double sum_of_squares(const CompiledDesign& design, const std::vector<ProbePoint>& points, const Pose& pose) {
  double sum = 0;
  for (const ProbePoint& point : points) {
    const ProjectionQuery query{apply(pose, Vec3(point.position.data())), Vec3::Zero(), 0.0};
    sum += project_global(design.surface(), query, nullptr).nearest.distance_squared();
  }
  return sum;
}

TEST(CoreMotionLock, FreeDirectionsKeepTheLockedDegreesOfFreedom) {
  const MotionFrame frame{Vec3(10, -20, 30), 100.0};
  const Pose pose{rotation_of({0.3, -0.2, 0.5}), Vec3(4, 5, 6)};
  for (std::uint8_t locked = 0; locked < kLockAll; ++locked) {
    const MotionBasis basis = free_motions(pose, locked, frame);
    EXPECT_LT((basis.directions.transpose() * basis.directions - Mat6::Identity()).norm(), 1e-13);
    int bits = 0;
    for (unsigned k = 0; k < 6; ++k) bits += (locked >> k & 1U) != 0 ? 1 : 0;
    ASSERT_EQ(basis.free, 6 - bits);
    for (int k = 0; k < basis.free; ++k) {
      const double h = 1e-4;
      const auto ahead = parameters_of(moved(pose, h * basis.directions.col(k), frame));
      const auto behind = parameters_of(moved(pose, -h * basis.directions.col(k), frame));
      for (unsigned j = 0; j < 6; ++j) {
        if ((locked >> j & 1U) != 0) {
          EXPECT_NEAR((ahead[j] - behind[j]) / (2 * h), 0.0, 1e-7) << int{locked} << ' ' << j;
        }
      }
    }
  }
}

TEST(CoreLock, TheOptimumIsStationaryInTheFreeDegreesOfFreedomOnly) {
  const ReferenceCase c = read_case("arl_fan");
  const std::vector<ProbePoint> points = points_of(c, "085");
  LocalizerConfig config = config_of(c, points.size());
  config.start = pose_of({0.1, -0.2, 0.05, 1e-3, -2e-3, 5e-4});
  const auto start = parameters_of(config.start);
  for (const int bits : {kLockTx | 0, kLockRy | kLockTz, kLockRx | kLockRy | kLockRz, kLockAll & ~kLockRz}) {
    const auto locked = static_cast<std::uint8_t>(bits);
    config.locked = locked;
    const Fit result = fit("arl_fan", points, config);
    ASSERT_EQ(result.status, Status::ok) << int{locked};
    const auto p = parameters_of(result.report.pose);
    for (unsigned j = 0; j < 6; ++j) {
      const double h = j < 3 ? 1e-4 : 1e-6;
      auto ahead = p, behind = p;
      ahead[j] += h;
      behind[j] -= h;
      const CompiledDesign& design = reference_design("arl_fan");
      const double slope =
          (sum_of_squares(design, points, pose_of(ahead)) - sum_of_squares(design, points, pose_of(behind))) / (2 * h) /
          (j < 3 ? 1.0 : 100.0);
      if ((locked >> j & 1U) == 0) {
        EXPECT_NEAR(slope, 0.0, 2e-5) << int{locked} << ' ' << j;
      } else {
        EXPECT_NEAR(p[j], start[j], 1e-15) << int{locked} << ' ' << j;
        EXPECT_GT(std::abs(slope), 1e-2) << int{locked} << ' ' << j;
      }
    }
  }
}

TEST(CoreLock, EveryModeHoldsItAndProvesItsOptimum) {
  const ReferenceCase c = read_case("arl_fan");
  const std::vector<ProbePoint> points = points_of(c, "085");
  LocalizerConfig config = config_of(c, points.size());
  config.tolerance.leading_edge_mm = 1.2;
  config.tolerance.rest_mm = 12;
  for (const FitMode mode : {FitMode::minimax, FitMode::range, FitMode::min_tolerance, FitMode::constrained}) {
    config.mode = mode;
    config.locked = 0;
    const Fit free = fit("arl_fan", points, config);
    config.locked = kLockTy | kLockRz;
    const Fit held = fit("arl_fan", points, config);
    ASSERT_EQ(held.status, Status::ok) << static_cast<int>(mode);
    const auto p = parameters_of(held.report.pose);
    EXPECT_EQ(p[1], 0.0);
    EXPECT_NEAR(p[5], 0.0, 1e-16);
    EXPECT_LT(held.report.stationarity, 1e-9);
    if (mode != FitMode::constrained) {
      EXPECT_GT(held.report.mode_value_mm, free.report.mode_value_mm);
      EXPECT_LE(held.report.certificate.count, 5U);
    } else {
      EXPECT_GT(held.report.rms_mm, free.report.rms_mm);
    }
  }
}

TEST(CoreWeights, APointOfWeightThreeCountsAsThree) {
  const ReferenceCase c = read_case("arl_fan");
  std::vector<ProbePoint> weighted = points_of(c, "041"), repeated;
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    const int copies = i % 3 == 0 ? 3 : 1;
    weighted[i].weight = copies;
    for (int k = 0; k < copies; ++k) {
      repeated.push_back(weighted[i]);
      repeated.back().weight = 1;
      repeated.back().sequence = static_cast<std::uint32_t>(repeated.size());
    }
  }
  const Fit a = fit("arl_fan", weighted, config_of(c, 0)), b = fit("arl_fan", repeated, config_of(c, 0));
  ASSERT_EQ(a.status, Status::ok);
  EXPECT_LT((a.report.pose.rotation - b.report.pose.rotation).norm(), 1e-12);
  EXPECT_LT((a.report.pose.translation - b.report.pose.translation).norm(), 1e-10);
  EXPECT_NEAR(a.report.rms_mm, b.report.rms_mm, 1e-12);
  OwnedLocalizer localizer(reference_design("arl_fan").image(), config_of(c, 10));
  for (const double weight : {0.0, -1.0, 1e-13, 1e13}) {
    weighted[0].weight = weight;
    EXPECT_EQ(localizer->stage(weighted[0]), Status::out_of_range);
  }
  weighted[0].weight = std::nan("");
  EXPECT_EQ(localizer->stage(weighted[0]), Status::not_finite);
}

TEST(CoreLoss, SlopeAndCurvatureAreDerivativesOfTheValue) {
  for (const Loss loss : {Loss::none, Loss::huber, Loss::tukey}) {
    for (double d = -0.731; d < 0.75; d += 0.037) {
      const double scale = 0.1, h = 1e-6;
      const LossTerms at = loss_terms(loss, scale, d), a = loss_terms(loss, scale, d + h),
                      b = loss_terms(loss, scale, d - h);
      EXPECT_NEAR(at.slope, (a.value - b.value) / (2 * h), 1e-8);
      EXPECT_NEAR(at.curvature, (a.slope - b.slope) / (2 * h), 1e-7);
      EXPECT_NEAR(at.weight * d, at.slope, 1e-15);
    }
  }
}

/// With every twentieth point off by millimetres a robust pose moves less than that of least squares.
TEST(CoreLoss, OutliersHardlyMoveARobustFit) {
  const ReferenceCase c = read_case("arl_fan");
  std::vector<ProbePoint> good, all = points_of(c, "full");
  std::mt19937_64 random(7);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 20 != 3) {
      good.push_back(all[i]);
    } else {
      for (double& x : all[i].position) x += uniform(random, 2.0, 6.0);
    }
  }
  const auto moved_by_them = [&](Loss loss) {
    LocalizerConfig config = config_of(c, 0);
    config.loss = loss;
    const Fit without = fit("arl_fan", good, config), with = fit("arl_fan", all, config);
    EXPECT_EQ(without.status, Status::ok);
    EXPECT_EQ(with.status, Status::ok);
    if (loss != Loss::none) {
      EXPECT_NEAR(with.report.loss_scale_mm, without.report.loss_scale_mm, 0.2 * without.report.loss_scale_mm);
    }
    const Vec3 corner(100, 250, 100);
    return (apply(with.report.pose, corner) - apply(without.report.pose, corner)).norm();
  };
  const double plain = moved_by_them(Loss::none);
  EXPECT_LT(moved_by_them(Loss::huber), 0.5 * plain);
  EXPECT_LT(moved_by_them(Loss::tukey), 0.25 * plain);
}

/// 5 mm and 3 degrees away, on a blade 2 % thick.
TEST(CoreStart, AFarStartEndsAtTheSamePose) {
  const ReferenceCase c = read_case("dtmb4119");
  const std::vector<ProbePoint> points = points_of(c, "200");
  const Fit near = fit("dtmb4119", points, config_of(c, 0));
  std::mt19937_64 random(11);
  for (int k = 0; k < 8; ++k) {
    LocalizerConfig config = config_of(c, 0);
    config.start.rotation = rotation_exp(3.0 * M_PI / 180.0 * random_direction_in_space(random));
    config.start.translation = 5.0 * random_direction_in_space(random);
    const Fit far = fit("dtmb4119", points, config);
    if (far.status != Status::ok) continue;  // it says that it did not converge
    EXPECT_LT((far.report.pose.rotation - near.report.pose.rotation).norm(), 1e-10) << k;
    EXPECT_LT((far.report.pose.translation - near.report.pose.translation).norm(), 1e-8) << k;
  }
}

/// Where a point counts it is drawn over an edge, and where it does not it comes back: it must come to rest outside of
/// the fit, the pose be the optimum of the others, and the point be judged by its foot there.
TEST(CoreEdges, APointThatWouldComeAndGoIsLeftOutOfTheFitAndJudged) {
  const ReferenceCase c = read_case("arl_fan");
  const CompiledDesign& design = reference_design("arl_fan");
  const std::vector<ProbePoint> points = thinned(c, 11, 44);
  const LocalizerConfig config = config_of(c, points.size());
  OwnedLocalizer localizer(design.image(), config);
  for (const ProbePoint& point : points) ASSERT_EQ(localizer->stage(point), Status::ok);
  localizer->conclude();
  ASSERT_EQ(refine_fully(*localizer), Status::ok);
  const FitReport report = localizer->fit();
  std::vector<ProbePoint> counted;
  int comes_and_goes = 0;
  for (const ProbePoint& point : points) {
    Verdict verdict;
    ASSERT_EQ(localizer->verdict_of(point.sequence, verdict), Status::ok);
    if (verdict.fitted) counted.push_back(point);
    EXPECT_EQ(verdict.state == PointState::rejected, verdict.foot.border != FootBorder::none);
    if (!verdict.fitted && verdict.foot.kind == FootKind::interior) ++comes_and_goes;
  }
  EXPECT_GT(comes_and_goes, 0);
  ASSERT_EQ(counted.size(), report.fitted);
  ASSERT_LT(counted.size(), points.size());
  const Fit others = fit("arl_fan", counted, config);
  ASSERT_EQ(others.status, Status::ok);
  EXPECT_LT((others.report.pose.translation - report.pose.translation).norm(), 1e-8);
  EXPECT_LT((others.report.pose.rotation - report.pose.rotation).norm(), 1e-10);
}

}  // namespace
}  // namespace bladefit::testing
