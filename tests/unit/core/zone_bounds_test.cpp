// The modes whose bounds are the limits of zones: against the definition with every foot searched again, against
// differences of the distances, and against NLopt's SLSQP.

#include <gtest/gtest.h>
#include <nlopt.h>

#include <cmath>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

constexpr double kBandFrom = 100.0;  ///< radius where the second zone begins [mm]
constexpr double kShareStep = 1e-4;  ///< of the differences [mm]
const Limits kEdgeLimits{0.05, 0.02}, kBandLimits{0.1, 0.3}, kRestLimits = Limits::both(0.25);

struct ZoneCase {
  FitMode mode;
  bool directions;
  double scale = 1;  ///< of all limits
};

LocalizerConfig zone_config(const ZoneCase& given, std::size_t points) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), points);
  config.mode = given.mode;
  config.use_approach = given.directions;
  ToleranceMap& map = config.tolerance;
  map = ToleranceMap();
  map.boxes[0] = {0, 0.4, 0.6, 0.0, 1.0, 1};
  map.box_count = 1;
  const auto zone = [&](Region region, bool everywhere, double from, const Limits& limits) {
    const double infinite = std::numeric_limits<double>::infinity();
    return ToleranceZone{region, everywhere, from, infinite, given.scale * limits.plus(), given.scale * limits.minus()};
  };
  map.zones[0] = zone(Region::leading_edge, false, 0.0, kEdgeLimits);
  map.zones[1] = zone(Region::rest, true, kBandFrom, kBandLimits);
  map.zone_count = 2;
  map.rest_mm = given.scale * kRestLimits.plus();
  return config;
}

/// The problem by its definition, apart from the localizer: its own search of feet, its own rule of zones.
class ZoneProblem {
 public:
  explicit ZoneProblem(const ZoneCase& given) : given_(given), points_(thinned(read_case("dtmb4119"), 0, 40)) {
    if (given.directions) return;
    for (ProbePoint& point : points_) point.approach = {};
  }
  [[nodiscard]] const std::vector<ProbePoint>& points() const { return points_; }
  [[nodiscard]] Foot foot(std::size_t i, const Pose& pose) const {
    ProjectionQuery query{apply(pose, Vec3(points_[i].position.data())), Vec3::Zero(), 0.0};
    if (given_.directions) query.approach = pose.rotation * Vec3(points_[i].approach.data());
    return foot_of(design_.surface(), project_global(design_.surface(), query, nullptr).nearest, 0.0);
  }
  [[nodiscard]] double distance(std::size_t i, const Pose& pose) const { return foot(i, pose).distance; }
  [[nodiscard]] Limits limits(const Foot& foot) const {
    const bool edge = foot.u >= 0.4 && foot.u <= 0.6, outer = std::hypot(foot.point.y(), foot.point.z()) >= kBandFrom;
    const Limits& limits = edge ? kEdgeLimits : outer ? kBandLimits : kRestLimits;
    return {given_.scale * limits.plus(), given_.scale * limits.minus()};
  }
  /// The smallest s with every distance within s times its limits.
  [[nodiscard]] double share(const Pose& pose) const {
    double share = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Foot found = foot(i, pose);
      share = std::max(share, std::abs(found.distance) / limits(found).of(found.distance));
    }
    return share;
  }
  [[nodiscard]] double squares(const Pose& pose) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) sum += std::pow(distance(i, pose), 2);
    return sum;
  }
  [[nodiscard]] Pose moved_by(const Pose& pose, const double* x) const {
    return moved(pose, Vec6(Eigen::Map<const Vec6>(x)), frame());
  }
  [[nodiscard]] MotionFrame frame() const { return {design_.surface().middle(), design_.surface().half_diagonal()}; }
  /// Of a distance in the six numbers of a motion about a pose.
  [[nodiscard]] Vec6 differences(std::size_t i, const Pose& pose) const {
    Vec6 out;
    for (int k = 0; k < 6; ++k) {
      const Vec6 step = kShareStep * Vec6::Unit(k);
      out[k] = (distance(i, moved(pose, step, frame())) - distance(i, moved(pose, Vec6(-step), frame()))) /
               (2.0 * kShareStep);
    }
    return out;
  }

  [[nodiscard]] FitReport fit(bool stream = false) const {
    OwnedLocalizer localizer(design_.image(), zone_config(given_, points_.size()));
    Verdict verdict;
    for (const ProbePoint& point : points_)
      EXPECT_TRUE(succeeded(stream ? localizer->push(point, verdict) : localizer->stage(point)));
    localizer->conclude();
    EXPECT_EQ(refine_fully(*localizer), Status::ok);
    return localizer->fit();
  }

 private:
  ZoneCase given_;
  const CompiledDesign& design_ = reference_design("dtmb4119");
  std::vector<ProbePoint> points_;
};

/// What NLopt is given: a motion about a pose, and the share behind it where that is the objective.
struct SecondProgram {
  const ZoneProblem& problem;
  Pose pose;
  bool squares;
};

double second_objective(unsigned n, const double* x, double* slope, void* data) {
  const auto& program = *static_cast<SecondProgram*>(data);
  if (slope) std::fill_n(slope, n, 0.0);
  if (!program.squares) {
    if (slope) slope[6] = 1.0;
    return x[6];
  }
  const Pose pose = program.problem.moved_by(program.pose, x);
  for (std::size_t i = 0; slope && i < program.problem.points().size(); ++i) {
    // The motions about two poses that are near to each other have the same slopes to first order.
    Eigen::Map<Vec6>(slope, 6) += 2.0 * program.problem.distance(i, pose) * program.problem.differences(i, pose);
  }
  return program.problem.squares(pose);
}

void second_bounds(unsigned m, double* result, unsigned n, const double* x, double* slope, void* data) {
  const auto& program = *static_cast<SecondProgram*>(data);
  const Pose pose = program.problem.moved_by(program.pose, x);
  const double share = program.squares ? 1.0 : x[6];
  if (slope) std::fill_n(slope, std::size_t{m} * n, 0.0);
  for (std::size_t i = 0; i < program.problem.points().size(); ++i) {
    const Foot foot = program.problem.foot(i, pose);
    const Limits limits = program.problem.limits(foot);
    result[2 * i] = foot.distance - share * limits.plus();
    result[2 * i + 1] = -foot.distance - share * limits.minus();
    if (!slope) continue;
    const Vec6 along = program.problem.differences(i, pose);
    double* above = slope + 2 * i * n;
    double* below = above + n;
    Eigen::Map<Vec6>(above, 6) = along;
    Eigen::Map<Vec6>(below, 6) = -along;
    if (program.squares) continue;
    above[6] = -limits.plus();
    below[6] = -limits.minus();
  }
}

/// Another solver from a pose: where it ends.
Pose solved_again(const ZoneProblem& problem, const Pose& start, bool squares) {
  Pose pose = start;
  for (int round = 0; round < 3; ++round) {
    SecondProgram program{problem, pose, squares};
    const unsigned n = squares ? 6 : 7, m = 2 * static_cast<unsigned>(problem.points().size());
    std::vector<double> x(n, 0.0), tolerance(m, 1e-10);
    if (!squares) x[6] = problem.share(pose);
    nlopt_opt optimizer = nlopt_create(NLOPT_LD_SLSQP, n);
    nlopt_set_min_objective(optimizer, second_objective, &program);
    nlopt_add_inequality_mconstraint(optimizer, m, second_bounds, &program, tolerance.data());
    nlopt_set_xtol_rel(optimizer, 1e-9);
    nlopt_set_maxeval(optimizer, 40);
    double value = 0;
    (void)nlopt_optimize(optimizer, x.data(), &value);
    nlopt_destroy(optimizer);
    pose = problem.moved_by(pose, x.data());
  }
  return pose;
}

class ZoneBounds : public ::testing::TestWithParam<bool> {
 protected:
  /// The smallest share of the limits as they are.
  [[nodiscard]] double least_share() const {
    return ZoneProblem({FitMode::min_tolerance, GetParam()}).fit().mode_value_mm / kEdgeLimits.nearer();
  }
};

TEST_P(ZoneBounds, TheSmallestMultipleOfAllLimitsIsFound) {
  const ZoneProblem problem({FitMode::min_tolerance, GetParam()});
  const FitReport fit = problem.fit();
  EXPECT_EQ(fit.status, FitStatus::converged);
  EXPECT_EQ(fit.smallest_tolerance_mm, fit.mode_value_mm) << "of the tightest limit of the leading edge";
  const double share = fit.mode_value_mm / kEdgeLimits.nearer();
  EXPECT_NEAR(problem.share(fit.pose), share, 1e-9);
  const Pose squares = ZoneProblem({FitMode::least_squares, GetParam()}).fit().pose;
  EXPECT_LT(share, problem.share(squares));
  EXPECT_NEAR(problem.share(solved_again(problem, squares, false)), share, 1e-5 * share) << "by another solver";
}

TEST_P(ZoneBounds, TheCertificateProvesIt) {
  const ZoneProblem problem({FitMode::min_tolerance, GetParam()});
  const FitReport fit = problem.fit();
  const double unit = kEdgeLimits.nearer(), share = fit.mode_value_mm / unit;
  ASSERT_GE(fit.certificate.count, 2U);
  Vec6 sum = Vec6::Zero();
  double weights = 0, largest = 0;
  for (std::uint32_t k = 0; k < fit.certificate.count; ++k) {
    const auto at = std::ranges::find(problem.points(), fit.certificate.sequence[k], &ProbePoint::sequence);
    const auto i = static_cast<std::size_t>(at - problem.points().begin());
    const Foot foot = problem.foot(i, fit.pose);
    const double limit = problem.limits(foot).of(foot.distance), multiplier = fit.certificate.multiplier[k];
    EXPECT_EQ(fit.certificate.sign[k], foot.distance > 0 ? 1 : -1);
    EXPECT_NEAR(std::abs(foot.distance) / limit, share, 1e-8 * share);
    EXPECT_GE(multiplier, 0.0);
    const Vec6 term = multiplier * fit.certificate.sign[k] * problem.differences(i, fit.pose);
    sum += term;
    largest = std::max(largest, term.norm());
    weights += multiplier * limit / unit;
  }
  EXPECT_LT(sum.norm(), 1e-5 * largest);
  EXPECT_NEAR(weights, 1.0, 1e-9);
}

TEST_P(ZoneBounds, AConstrainedFitKeepsBothLimitsOfEveryZone) {
  const ZoneProblem problem({FitMode::constrained, GetParam(), 1.05 * least_share()});
  const FitReport fit = problem.fit();
  EXPECT_EQ(fit.status, FitStatus::converged);
  EXPECT_EQ(fit.certificate.count, 0U);
  EXPECT_LE(problem.share(fit.pose), 1.0 + 1e-8);
  const ZoneProblem free({FitMode::least_squares, GetParam()});
  const Pose squares = free.fit().pose;
  EXPECT_GT(problem.share(squares), 1.0) << "or nothing was bounded";
  const Pose tightest = ZoneProblem({FitMode::min_tolerance, GetParam()}).fit().pose;
  EXPECT_LT(problem.squares(fit.pose), problem.squares(tightest));
  const Pose again = solved_again(problem, tightest, true);
  EXPECT_LE(problem.share(again), 1.0 + 1e-6);
  EXPECT_NEAR(problem.squares(fit.pose), problem.squares(again), 1e-5 * problem.squares(again)) << "another solver";
}

TEST_P(ZoneBounds, WhatCannotBeMetIsProvenWithTheFactorThatCan) {
  const double share = least_share();
  const ZoneProblem problem({FitMode::constrained, GetParam(), 0.9 * share});
  const FitReport fit = problem.fit();
  EXPECT_EQ(fit.status, FitStatus::infeasible);
  EXPECT_GT(fit.certificate.count, 0U);
  EXPECT_NEAR(fit.smallest_tolerance_mm, share * kEdgeLimits.nearer(), 1e-8);
  EXPECT_EQ(fit.mode_value_mm, fit.smallest_tolerance_mm);
  EXPECT_NEAR(problem.share(fit.pose), 1.0 / 0.9, 1e-7);
}

TEST_P(ZoneBounds, PointByPointItIsTheSame) {
  const double share = least_share();
  for (const double scale : {0.9, 1.05}) {
    const ZoneProblem problem({FitMode::constrained, GetParam(), scale * share});
    const FitReport whole = problem.fit(), pushed = problem.fit(true);
    EXPECT_EQ(pushed.status, whole.status);
    EXPECT_NEAR(pushed.rms_mm, whole.rms_mm, 1e-9);
    EXPECT_NEAR(pushed.smallest_tolerance_mm, whole.smallest_tolerance_mm, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, ZoneBounds, ::testing::Bool());

/// The same limits on both sides, in two regions, are the leading edge and the rest of a design without zones.
TEST(ZoneBounds, OfSymmetricZonesAreThoseOfTheTwoRegions) {
  for (const FitMode mode : {FitMode::min_tolerance, FitMode::constrained}) {
    const std::vector<ProbePoint> points = thinned(read_case("dtmb4119"), 0, 200);
    LocalizerConfig config = zone_config({mode, true}, points.size());
    config.tolerance.zone_count = 1;
    config.tolerance.zones[0].plus_mm = config.tolerance.zones[0].minus_mm = 0.02;
    config.tolerance.rest_mm = 0.2;
    LocalizerConfig plain = config;
    plain.tolerance.zone_count = plain.tolerance.boxes[0].zone = 0;
    plain.tolerance.leading_edge_mm = 0.02;
    const auto fit = [&](const LocalizerConfig& wanted) {
      OwnedLocalizer localizer(reference_design("dtmb4119").image(), wanted);
      for (const ProbePoint& point : points) EXPECT_EQ(localizer->stage(point), Status::ok);
      localizer->conclude();
      EXPECT_EQ(refine_fully(*localizer), Status::ok);
      return localizer->fit();
    };
    const FitReport zoned = fit(config), two = fit(plain);
    EXPECT_EQ(zoned.status, two.status);
    EXPECT_NEAR(zoned.mode_value_mm, two.mode_value_mm, 1e-12);
    EXPECT_NEAR(zoned.rms_mm, two.rms_mm, 1e-11);
    EXPECT_LT((zoned.pose.translation - two.pose.translation).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace bladefit::testing
