#include "core/fit/pose_solver.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/fit/symmetric_eigen.hpp"

namespace bladefit {

using Square6 = Eigen::Matrix<double, 6, 6>;

Determination determine(const QuadraticModel& model, double threshold) {
  const SymmetricEigen eigen = symmetric_eigen(model.gauss);
  Determination out;
  int free = 0;
  for (int k = 0; k < 6; ++k) {
    const Vec6 direction = eigen.vectors.col(k);
    if (model.count > 0 && eigen.values[k] >= threshold) {
      out.projector += direction * direction.transpose();
      ++out.rank;
    } else {
      out.free_directions.col(free++) = direction;
    }
  }
  if (out.rank == 6) out.projector.setIdentity();
  out.smallest = model.count > 0 ? std::max(0.0, eigen.values[0]) / static_cast<double>(model.count) : 0.0;
  return out;
}

Vec6 minimum_of(const QuadraticModel& model, const Determination& determination, const Vec6& x0) {
  if (determination.rank == 0) return x0;
  const Mat6& p = determination.projector;
  const Mat6 rest = Mat6::Identity() - p;
  const Square6 hessian = model.gauss + model.bend;
  const Vec6 gradient = p * (model.gradient + hessian * x0);
  const Square6 newton = p * hessian * p + rest;
  const Eigen::LLT<Square6> decomposition(newton);
  if (decomposition.info() == Eigen::Success) return x0 - p * decomposition.solve(gradient);
  const Square6 gauss = p * model.gauss * p + rest;
  return x0 - p * Eigen::LLT<Square6>(gauss).solve(gradient);
}

Mat6 unit_covariance(const QuadraticModel& model, const Determination& determination, double ridge) {
  const Square6 information = model.gauss + ridge * (Mat6::Identity() - determination.projector);
  return Eigen::LLT<Square6>(information).solve(Square6::Identity());
}

Mat6 pose_covariance(const Mat6& covariance_of_x, const Pose& pose, const MotionFrame& frame) {
  // w = x_w / L; dt = s + w x (t - pivot).
  const Vec3 arm = pose.translation - frame.pivot;
  Mat3 cross;
  cross << 0.0, arm[2], -arm[1], -arm[2], 0.0, arm[0], arm[1], -arm[0], 0.0;
  Mat6 map = Mat6::Identity();
  map.topLeftCorner<3, 3>() /= frame.length;
  map.bottomLeftCorner<3, 3>() = cross / frame.length;
  return map * covariance_of_x * map.transpose();
}

}  // namespace bladefit
