#include "core/fit/pose_solver.hpp"

#include <algorithm>

#include "core/fit/cholesky.hpp"
#include "core/fit/symmetric_eigen.hpp"

namespace bladefit {

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
  const Mat6 hessian = model.gauss + model.bend;
  const Vec6 gradient = p * (model.gradient + hessian * x0);
  const Cholesky newton(p * hessian * p + rest);
  if (newton.positive_definite()) return x0 - p * newton.solve(gradient);
  const Cholesky gauss(p * model.gauss * p + rest);
  return gauss.positive_definite() ? Vec6(x0 - p * gauss.solve(gradient)) : x0;
}

Mat6 unit_covariance(const QuadraticModel& model, const Determination& determination, double ridge) {
  const Cholesky information(model.gauss + ridge * (Mat6::Identity() - determination.projector));
  return information.positive_definite() ? information.inverse() : Mat6(Mat6::Identity() / ridge);
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
