#include "tests/bench/fit_check.hpp"

#include <algorithm>
#include <limits>

#include "tests/bench/peers/distance_model.hpp"

namespace bladefit::bench {

double displacement(const FitProblem& problem, const Pose& pose, const Pose& other) {
  Vec3 low = problem.points.front(), high = low;
  for (const Vec3& point : problem.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  double most = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1 ? high : low).x(), (corner & 2 ? high : low).y(), (corner & 4 ? high : low).z());
    most = std::max(most, (apply(pose, p) - apply(other, p)).norm());
  }
  return most;
}

double tolerance_at(const BenchDesign& design, const FitCase& fit, const Pose& pose,
                    const std::vector<double>& weights) {
  const FitProblem problem = at_pose(design, fit, pose);
  double most = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double distance = (apply(pose, problem.points[i]) - Vec3(design.textbook.evaluate(problem.feet[i]).s)).norm();
    most = std::max(most, distance / weights[i]);
  }
  return most;
}

Pose best_of(const BenchDesign& design, const FitCase& fit, const std::vector<Pose>& poses) {
  constexpr double kRounding = 1e-10;
  std::vector<double> sums, gradients;
  for (const Pose& pose : poses) {
    const double still[6] = {};
    const FitProblem problem = at_pose(design, fit, pose);
    DistanceModel model(design.textbook, design.reference.normal_sign, problem);
    model.evaluate(still);
    sums.push_back(model.distances().squaredNorm());
    gradients.push_back((model.jacobian().transpose() * model.distances()).norm());
  }
  const double least_sum = *std::min_element(sums.begin(), sums.end());
  std::size_t best = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (sums[k] > least_sum * (1.0 + kRounding) || gradients[k] >= smallest) continue;
    smallest = gradients[k];
    best = k;
  }
  return poses[best];
}

}  // namespace bladefit::bench
