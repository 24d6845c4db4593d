#include "tests/golden/second_solver.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace bladefit::testing {
namespace {

constexpr double kStep = 1e-4;   // of the differences [mm]
constexpr double kLooked = 0.4;  // points whose distance is this share of the largest are bounded
constexpr int kRounds = 8, kMostEvaluations = 150;
constexpr double kScale = 10.0;  // mm of one turn variable

/// The distances of chosen points as functions of six numbers [mm] about a pose, and their differences.
class Distances {
 public:
  Distances(const ModeValue& objective, const Pose& pose) : objective_(objective), pose_(pose) {
    for (const ProbePoint& point : objective.points()) centre_ += apply(pose, Vec3(point.position.data()));
    centre_ /= static_cast<double>(objective.points().size());
  }

  [[nodiscard]] Pose pose_at(const double* x) const {
    Vec6 step;
    for (int k = 0; k < 6; ++k) step[k] = k < 3 ? x[k] / kScale : x[k];
    return moved(pose_, step, centre_);
  }

  /// d / w, or d where `plain`.
  [[nodiscard]] double at(std::size_t point, const double* x, bool plain) const {
    const Foot foot = objective_.foot(objective_.points()[point], pose_at(x));
    return foot.distance / (plain ? 1.0 : objective_.weight(foot));
  }

  void differences(std::size_t point, const double* x, bool plain, double* out) const {
    double there[6];
    std::copy_n(x, 6, there);
    for (int k = 0; k < 6; ++k) {
      there[k] = x[k] + kStep;
      const double above = at(point, there, plain);
      there[k] = x[k] - kStep;
      out[k] = (above - at(point, there, plain)) / (2.0 * kStep);
      there[k] = x[k];
    }
  }

 private:
  const ModeValue& objective_;
  Pose pose_;
  Vec3 centre_ = Vec3::Zero();
};

/// What NLopt's functions are given.
struct Program {
  const ModeValue& objective;
  Distances distances;
  std::vector<std::size_t> bounded;  ///< points with constraints
  [[nodiscard]] bool squares() const { return objective.config().mode == FitMode::constrained; }
  [[nodiscard]] bool range() const { return objective.config().mode == FitMode::range; }
  /// Beside the six of the pose: the bound, or the upper and the lower one.
  [[nodiscard]] unsigned variables() const { return squares() ? 6 : range() ? 8 : 7; }
};

double value_of(unsigned n, const double* x, double* gradient, void* data) {
  const Program& program = *static_cast<Program*>(data);
  if (gradient) std::fill_n(gradient, n, 0.0);
  if (!program.squares()) {
    if (gradient) gradient[6] = 1.0;
    if (gradient && program.range()) gradient[7] = -1.0;
    return program.range() ? x[6] - x[7] : x[6];
  }
  double sum = 0, slope[6];
  for (std::size_t k = 0; k < program.objective.points().size(); ++k) {
    const double weight = program.objective.points()[k].weight, d = program.distances.at(k, x, true);
    sum += weight * d * d;
    if (!gradient) continue;
    program.distances.differences(k, x, true, slope);
    for (int i = 0; i < 6; ++i) gradient[i] += 2.0 * weight * d * slope[i];
  }
  return sum;
}

/// Two rows a point: upper - d / w >= 0 and d / w - lower >= 0, as NLopt wants them: negative.
void bounds_of(unsigned m, double* result, unsigned n, const double* x, double* gradient, void* data) {
  const Program& program = *static_cast<Program*>(data);
  if (gradient) std::fill_n(gradient, static_cast<std::size_t>(m) * n, 0.0);
  const double upper = program.squares() ? 1.0 : x[6];
  const double lower = program.range() ? x[7] : -upper;
  for (std::size_t k = 0; k < program.bounded.size(); ++k) {
    const double d = program.distances.at(program.bounded[k], x, program.range());
    result[2 * k] = d - upper;
    result[2 * k + 1] = lower - d;
    if (!gradient) continue;
    double* above = gradient + 2 * k * n;
    double* below = above + n;
    program.distances.differences(program.bounded[k], x, program.range(), above);
    for (int i = 0; i < 6; ++i) below[i] = -above[i];
    if (program.squares()) continue;
    above[6] = -1.0;
    below[program.range() ? 7 : 6] = program.range() ? 1.0 : -1.0;
  }
}

/// Points whose distance is large, or that are bounded already.
void bound_large(Program& program, const Pose& pose) {
  const ModeValue& objective = program.objective;
  std::vector<double> sizes;
  double least = 0, most = 0;
  for (const ProbePoint& point : objective.points()) {
    const Foot foot = objective.foot(point, pose);
    sizes.push_back(foot.distance / objective.weight(foot));
    least = std::min(least, sizes.back());
    most = std::max(most, sizes.back());
  }
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const bool large = program.range() ? sizes[k] > kLooked * most || sizes[k] < kLooked * least
                                       : std::abs(sizes[k]) > kLooked * std::max(most, -least);
    if (large && !std::binary_search(program.bounded.begin(), program.bounded.end(), k))
      program.bounded.insert(std::upper_bound(program.bounded.begin(), program.bounded.end(), k), k);
  }
}

}  // namespace

SecondOptimum solve_again(const ModeValue& objective, const Pose& start) {
  SecondOptimum best{objective.at(start), start};
  if (objective.config().mode == FitMode::constrained && objective.largest_ratio(start) > 1.0)
    best.value = std::numeric_limits<double>::infinity();
  Pose here = start;
  std::vector<std::size_t> bounded;
  for (int round = 0; round < kRounds; ++round) {
    Program program{objective, Distances(objective, here), bounded};
    bound_large(program, here);
    const unsigned n = program.variables(), m = 2 * static_cast<unsigned>(program.bounded.size());
    std::vector<double> x(n, 0.0);
    const double size = objective.largest_ratio(here);
    if (n > 6) x[6] = size;
    if (n > 7) x[7] = -size;
    nlopt_opt optimizer = nlopt_create(NLOPT_LD_SLSQP, n);
    nlopt_set_min_objective(optimizer, value_of, &program);
    const std::vector<double> tolerance(m, 1e-10);
    nlopt_add_inequality_mconstraint(optimizer, m, bounds_of, &program, tolerance.data());
    nlopt_set_xtol_rel(optimizer, 1e-11);
    nlopt_set_maxeval(optimizer, kMostEvaluations);
    double value = 0;
    (void)nlopt_optimize(optimizer, x.data(), &value);
    nlopt_destroy(optimizer);
    here = program.distances.pose_at(x.data());
    bounded = program.bounded;
    const bool kept = objective.config().mode != FitMode::constrained || objective.largest_ratio(here) <= 1.0 + 1e-8;
    const double there = kept ? objective.at(here) : std::numeric_limits<double>::infinity();
    const bool better = there < best.value * (1.0 - 1e-9);
    if (there < best.value) best = {there, here};
    if (!better && round > 0) break;
  }
  return best;
}

}  // namespace bladefit::testing
