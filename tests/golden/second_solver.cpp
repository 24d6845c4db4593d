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
  Distances(const ModeValue& objective, const std::vector<double>& weights, const Pose& pose)
      : objective_(objective), weights_(weights), pose_(pose) {
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
    return foot.distance / (plain ? 1.0 : weights_[point]);
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
  const std::vector<double>& weights_;
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

/// d / w of every point at a pose.
std::vector<double> sizes_at(const ModeValue& objective, const std::vector<double>& weights, const Pose& pose) {
  std::vector<double> sizes;
  for (std::size_t k = 0; k < weights.size(); ++k)
    sizes.push_back(objective.foot(objective.points()[k], pose).distance / weights[k]);
  return sizes;
}

/// Points whose distance is large, or that are bounded already.
void bound_large(Program& program, const std::vector<double>& sizes) {
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
  std::vector<bool> wanted(sizes.size());
  for (const std::size_t k : program.bounded) wanted[k] = true;
  program.bounded.clear();
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const bool large = program.range() ? sizes[k] > kLooked * *most || sizes[k] < kLooked * *least
                                       : std::abs(sizes[k]) > kLooked * std::max(*most, -*least);
    if (large || wanted[k]) program.bounded.push_back(k);
  }
}

/// The mode's objective; infinite where a bound of a constrained fit is broken.
double value_at(const ModeValue& objective, const std::vector<double>& sizes, const Pose& pose) {
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
  const double largest = std::max(*most, -*least);
  if (objective.config().mode == FitMode::range) return *most - *least;
  if (objective.config().mode != FitMode::constrained) return largest;
  return largest > 1.0 + 1e-8 ? std::numeric_limits<double>::infinity() : objective.at(pose);
}

/// One run of SLSQP about a pose.
Pose solve_once(Program& program, double largest) {
  const unsigned n = program.variables(), m = 2 * static_cast<unsigned>(program.bounded.size());
  std::vector<double> x(n, 0.0);
  if (n > 6) x[6] = largest;
  if (n > 7) x[7] = -largest;
  nlopt_opt optimizer = nlopt_create(NLOPT_LD_SLSQP, n);
  nlopt_set_min_objective(optimizer, value_of, &program);
  const std::vector<double> tolerance(m, 1e-10);
  nlopt_add_inequality_mconstraint(optimizer, m, bounds_of, &program, tolerance.data());
  nlopt_set_xtol_rel(optimizer, 1e-11);
  nlopt_set_maxeval(optimizer, kMostEvaluations);
  double value = 0;
  (void)nlopt_optimize(optimizer, x.data(), &value);
  nlopt_destroy(optimizer);
  return program.distances.pose_at(x.data());
}

}  // namespace

SecondOptimum solve_again(const ModeValue& objective, const std::vector<double>& weights, const Pose& start) {
  std::vector<double> sizes = sizes_at(objective, weights, start);
  SecondOptimum best{value_at(objective, sizes, start), start};
  Pose here = start;
  std::vector<std::size_t> bounded;
  for (int round = 0; round < kRounds; ++round) {
    Program program{objective, Distances(objective, weights, here), bounded};
    bound_large(program, sizes);
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    here = solve_once(program, std::max(*most, -*least));
    bounded = program.bounded;
    sizes = sizes_at(objective, weights, here);
    const double there = value_at(objective, sizes, here);
    const bool better = there < best.value * (1.0 - 1e-9);
    if (there < best.value) best = {there, here};
    if (!better && round > 0) break;
  }
  return best;
}

}  // namespace bladefit::testing
