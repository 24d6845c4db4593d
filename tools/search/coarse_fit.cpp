#include "tools/search/coarse_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/algebra/cholesky.hpp"
#include "core/algebra/cross_matrix.hpp"

namespace bladefit {
namespace {

/// Share of the trace that is added to the diagonal, so that points in one line or plane move nothing else.
constexpr double kDamping = 1e-6;

/// Normal equations of a step (w, dt) about `pivot`: points at p + w x (p - pivot) + dt.
struct StepEquations {
  Mat6 matrix = Mat6::Zero();
  Vec6 right = Vec6::Zero();

  void add(const Vec3& arm, const Vec3& error, const Vec3& normal, double weight, double tangential) {
    Vec6 row;
    row << arm.cross(normal), normal;
    matrix.noalias() += (weight * row) * row.transpose();
    right -= weight * normal.dot(error) * row;
    const double w = weight * tangential;
    const Mat3 cross = cross_matrix(arm);
    matrix.topLeftCorner<3, 3>() -= w * (cross * cross);
    matrix.topRightCorner<3, 3>() += w * cross;
    matrix.bottomLeftCorner<3, 3>() -= w * cross;
    matrix.bottomRightCorner<3, 3>().diagonal().array() += w;
    right.head<3>() -= w * arm.cross(error);
    right.tail<3>() -= w * error;
  }

  /// False where the equations determine no step.
  [[nodiscard]] bool solve(Vec6& step) {
    // The rotations are of other units than the translations: each block has its own scale.
    matrix.diagonal().head<3>().array() += kDamping * matrix.diagonal().head<3>().sum();
    matrix.diagonal().tail<3>().array() += kDamping * matrix.diagonal().tail<3>().sum();
    const Cholesky factor(matrix);
    if (!factor.positive_definite()) return false;
    step = factor.solve(right);
    return step.allFinite();
  }
};

}  // namespace

void fit_coarsely(const SampleGrid& grid, std::span<const Vec3> points, const CoarsePlan& plan, Pose& pose) {
  const double square = plan.reach_mm * plan.reach_mm;
  for (int k = 0; k < plan.steps; ++k) {
    StepEquations equations;
    Vec3 pivot = Vec3::Zero();
    for (const Vec3& point : points) pivot += apply(pose, point);
    pivot /= static_cast<double>(points.size());
    for (const Vec3& point : points) {
      const Vec3 at = apply(pose, point);
      const DesignSample& sample = grid.near(at);
      const Vec3 error = at - sample.point;
      const double fall = 1.0 / (1.0 + error.squaredNorm() / square);
      equations.add(at - pivot, error, sample.normal, fall * fall, plan.tangential);
    }
    Vec6 step;
    if (!equations.solve(step)) return;
    pose = moved(pose, step, pivot);
  }
}

double coarse_misfit(const SampleGrid& grid, std::span<const Vec3> points, const Pose& pose, double reach_mm,
                     double spacing_mm) {
  double sum = 0;
  for (const Vec3& point : points) {
    const Vec3 at = apply(pose, point);
    const DesignSample& sample = grid.near(at);
    const Vec3 error = at - sample.point;
    const double normal = error.dot(sample.normal);
    const double along = std::max(0.0, std::sqrt(std::max(0.0, error.squaredNorm() - normal * normal)) - spacing_mm);
    sum += std::min(normal * normal + along * along, reach_mm * reach_mm);
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace bladefit
