// NLopt's SLSQP on the six variables of DistanceModel, with analytic derivatives.

#include <algorithm>
#include <limits>
#include <nlopt.hpp>

#include "tests/bench/peers/distance_model.hpp"

namespace bladefit::bench {
namespace {

constexpr int kMaxEvaluations = 1000;

/// Half the mean square: its second derivatives are about 1, what SLSQP starts from. With the sum, the first step would
/// lead far off the blade.
double half_mean_square(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
  DistanceModel& model = *static_cast<DistanceModel*>(data);
  model.evaluate(x.data());
  const auto count = static_cast<double>(model.size());
  if (!gradient.empty()) {
    Eigen::Map<DistanceModel::Vector6>(gradient.data()) = model.jacobian().transpose() * model.distances() / count;
  }
  return 0.5 * model.distances().squaredNorm() / count;
}

/// SLSQP raises an error where rounding stops it: what it has found by then is its answer.
void optimise(nlopt::opt& optimiser, std::vector<double>& x) {
  optimiser.set_maxeval(kMaxEvaluations);
  double value = 0;
  try {
    optimiser.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {
  }
}

Pose nlopt_least_squares(const TextbookSurface& surface, int outward, const FitProblem& problem) {
  DistanceModel model(surface, outward, problem);
  nlopt::opt optimiser(nlopt::LD_SLSQP, 6);
  optimiser.set_min_objective(half_mean_square, &model);
  optimiser.set_ftol_rel(1e-15);
  std::vector<double> x(6, 0.0);
  optimise(optimiser, x);
  return model.pose_at(x.data());
}

/// Epigraph form: the least s with +-d_i <= s w_i. Variables (x, s).
struct Epigraph {
  DistanceModel model;
  const std::vector<double>& weights;
};

double last_variable(const std::vector<double>& x, std::vector<double>& gradient, void* /*data*/) {
  std::fill(gradient.begin(), gradient.end(), 0.0);
  if (!gradient.empty()) gradient.back() = 1.0;
  return x.back();
}

void bounds(unsigned m, double* result, unsigned n, const double* x, double* gradient, void* data) {
  Epigraph& epigraph = *static_cast<Epigraph*>(data);
  DistanceModel& model = epigraph.model;
  model.evaluate(x);
  for (unsigned i = 0; i < m / 2; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double d = model.distances()[row], w = epigraph.weights[i];
    result[2 * i] = d - x[n - 1] * w;
    result[2 * i + 1] = -d - x[n - 1] * w;
    if (gradient == nullptr) continue;
    for (unsigned k = 0; k < 6; ++k) {
      const double slope = model.jacobian()(row, static_cast<Eigen::Index>(k));
      gradient[(2 * i) * n + k] = slope;
      gradient[(2 * i + 1) * n + k] = -slope;
    }
    gradient[(2 * i) * n + 6] = gradient[(2 * i + 1) * n + 6] = -w;
  }
}

Pose nlopt_min_tolerance(const TextbookSurface& surface, int outward, const FitProblem& problem) {
  Epigraph epigraph{DistanceModel(surface, outward, problem), problem.weights};
  std::vector<double> x(7, 0.0);
  epigraph.model.evaluate(x.data());
  for (std::size_t i = 0; i < problem.weights.size(); ++i) {
    const double d = epigraph.model.distances()[static_cast<Eigen::Index>(i)];
    x[6] = std::max(x[6], std::abs(d) / problem.weights[i]);
  }
  nlopt::opt optimiser(nlopt::LD_SLSQP, 7);
  optimiser.set_min_objective(last_variable, nullptr);
  optimiser.add_inequality_mconstraint(bounds, &epigraph, std::vector<double>(2 * problem.weights.size(), 1e-13));
  optimiser.set_ftol_rel(1e-13);
  optimise(optimiser, x);
  return epigraph.model.pose_at(x.data());
}

}  // namespace

std::vector<Peer> nlopt_peers(const UnitSurface& surface, int outward) {
  const auto tree = std::make_shared<SampleTree>(surface, outward);
  Peer peer;
  peer.name = "NLopt, SLSQP";
  peer.least_squares = [tree, outward](const FitProblem& problem) {
    return solved_from_cold(
        *tree, problem, [&](const FitProblem& known) { return nlopt_least_squares(tree->surface(), outward, known); });
  };
  peer.min_tolerance = [tree, outward](const FitProblem& problem) {
    return nlopt_min_tolerance(tree->surface(), outward, problem);
  };
  return {peer};
}

}  // namespace bladefit::bench
