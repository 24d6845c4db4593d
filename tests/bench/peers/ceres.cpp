// Ceres on the least-squares problem, in two exact forms: six variables, with the feet renewed in every evaluation; and
// the pose and all (u, v) as variables together, the latter eliminated point by point (Schur complement).

#include <ceres/ceres.h>

#include <Eigen/Geometry>
#include <array>

#include "tests/bench/peers/distance_model.hpp"

namespace bladefit::bench {
namespace {

/// Gauss-Newton: the trust region is so wide that only a step that fails narrows it.
ceres::Solver::Options gauss_newton(ceres::LinearSolverType solver) {
  ceres::Solver::Options options;
  options.linear_solver_type = solver;
  options.initial_trust_region_radius = 1e16;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-20;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  return options;
}

class RenewedDistances : public ceres::CostFunction {
 public:
  explicit RenewedDistances(DistanceModel& model) : model_(model) {
    mutable_parameter_block_sizes()->push_back(6);
    set_num_residuals(static_cast<int>(model.size()));
  }
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    model_.evaluate(parameters[0]);
    Eigen::Map<Eigen::VectorXd>(residuals, model_.size()) = model_.distances();
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<DistanceModel::Jacobian>(jacobians[0], model_.size(), 6) = model_.jacobian();
    }
    return true;
  }

 private:
  DistanceModel& model_;
};

Pose ceres_renewed(const TextbookSurface& surface, int outward, const FitProblem& problem) {
  DistanceModel model(surface, outward, problem);
  double x[6] = {};
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new RenewedDistances(model), nullptr, x);
  ceres::Solver::Summary summary;
  ceres::Solve(gauss_newton(ceres::DENSE_NORMAL_CHOLESKY), &ceres_problem, &summary);
  return model.pose_at(x);
}

/// r_i(x) - S(u_i, v_i).
class Offset : public ceres::SizedCostFunction<3, 6, 2> {
 public:
  Offset(const DistanceModel& model, const TextbookSurface& surface, std::size_t point)
      : model_(model), surface_(surface), point_(point) {}
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const DistanceModel::Moved moved = model_.moved_point(point_, parameters[0]);
    const TextbookPoint foot = surface_.evaluate({parameters[1][0], parameters[1][1]});
    Eigen::Map<Eigen::Vector3d> residual(residuals);
    residual = moved.r - foot.s;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, 6, Eigen::RowMajor>> by_pose(jacobians[0]);
      by_pose = moved.derivative;
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, 2, Eigen::RowMajor>> by_foot(jacobians[1]);
      by_foot << -foot.s_u, -foot.s_v;
    }
    return true;
  }

 private:
  const DistanceModel& model_;
  const TextbookSurface& surface_;
  std::size_t point_;
};

Pose ceres_joint(const TextbookSurface& surface, int outward, const FitProblem& problem) {
  const DistanceModel model(surface, outward, problem);
  double x[6] = {};
  std::vector<std::array<double, 2>> feet;
  for (const Parameters& foot : problem.feet) feet.push_back({foot.u, foot.v});
  ceres::Problem ceres_problem;
  auto* order = new ceres::ParameterBlockOrdering;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    ceres_problem.AddResidualBlock(new Offset(model, surface, i), nullptr, x, feet[i].data());
    for (int k = 0; k < 2; ++k) {
      ceres_problem.SetParameterLowerBound(feet[i].data(), k, 0.0);
      ceres_problem.SetParameterUpperBound(feet[i].data(), k, 1.0);
    }
    order->AddElementToGroup(feet[i].data(), 0);
  }
  order->AddElementToGroup(x, 1);
  ceres::Solver::Options options = gauss_newton(ceres::DENSE_SCHUR);
  options.linear_solver_ordering.reset(order);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  return model.pose_at(x);
}

using Form = Pose (*)(const TextbookSurface&, int, const FitProblem&);

Peer ceres_peer(const std::shared_ptr<SampleTree>& tree, int outward, const char* name, Form form) {
  Peer peer;
  peer.name = name;
  peer.least_squares = [tree, outward, form](const FitProblem& problem) {
    return solved_from_cold(*tree, problem,
                            [&](const FitProblem& known) { return form(tree->surface(), outward, known); });
  };
  return peer;
}

}  // namespace

std::vector<Peer> ceres_peers(const UnitSurface& surface, int outward) {
  const auto tree = std::make_shared<SampleTree>(surface, outward);
  return {ceres_peer(tree, outward, "Ceres, feet renewed", ceres_renewed),
          ceres_peer(tree, outward, "Ceres, joint in pose and (u, v)", ceres_joint)};
}

}  // namespace bladefit::bench
