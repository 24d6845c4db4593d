#include "core/fit/pose_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/algebra/cholesky.hpp"
#include "core/algebra/cross_matrix.hpp"

namespace bladefit {
namespace {

/// 99.5 % of a normal variable lie below this many standard deviations.
constexpr double kNormalQuantile = 2.576;

}  // namespace

MotionSpectrum spectrum_of(const QuadraticModel& model, const MotionBasis& basis) {
  MotionSpectrum out;
  if (basis.free == 6) {
    out.eigen = symmetric_eigen(model.gauss);
    return out;
  }
  // Locked directions get an eigenvalue above all others, so that no eigenvector mixes them with free ones.
  const double above = 4.0 * (model.gauss.trace() + 1.0);
  out.unlocked = basis.projector();
  out.locked = static_cast<std::uint32_t>(6 - basis.free);
  out.eigen = symmetric_eigen(out.unlocked * model.gauss * out.unlocked + above * (Mat6::Identity() - out.unlocked));
  for (int k = 0; k < 6; ++k) {
    if (out.eigen.values[k] > 0.5 * above) out.eigen.values[k] = std::numeric_limits<double>::infinity();
  }
  return out;
}

double noise_bound(const QuadraticModel& model, const MotionSpectrum& spectrum, const Vec6& x, double reach) {
  const double freedom = static_cast<double>(model.count) + static_cast<double>(spectrum.locked) - 6.0;
  // The lower end of the confidence interval of chi squared, by the cube of a normal variable (Wilson and Hilferty).
  const double spread = 2.0 / (9.0 * freedom);
  const double root = freedom >= 1.0 ? 1.0 - spread - kNormalQuantile * std::sqrt(spread) : 0.0;
  if (root <= 0.0) return std::numeric_limits<double>::infinity();
  const Vec6 gradient = model.gradient + (model.gauss + model.bend) * x;
  double left = model.value_at(x);
  for (int k = 0; k < 6; ++k) {
    const double eigenvalue = spectrum.eigen.values[k], slope = std::abs(spectrum.eigen.vectors.col(k).dot(gradient));
    const double step = slope < eigenvalue * reach ? slope / eigenvalue : reach;
    if (std::isfinite(eigenvalue)) left -= step * (slope - 0.5 * eigenvalue * step);
  }
  return 2.0 * std::max(0.0, left) / (freedom * root * root * root);
}

Determination determine(const QuadraticModel& model, const MotionSpectrum& spectrum, double threshold) {
  Determination out;
  out.unlocked = spectrum.unlocked;
  out.locked = spectrum.locked;
  int free = 0;
  for (int k = 0; k < 6; ++k) {
    const Vec6 direction = spectrum.eigen.vectors.col(k);
    if (std::isinf(spectrum.eigen.values[k])) {
      ++out.rank;
    } else if (model.count > 0 && spectrum.eigen.values[k] >= threshold) {
      out.projector += direction * direction.transpose();
      ++out.rank;
    } else {
      out.free_directions.col(free++) = direction;
    }
  }
  if (out.rank == 6) out.projector = out.unlocked;
  out.smallest = model.count > 0 ? std::max(0.0, spectrum.eigen.values[0]) / static_cast<double>(model.count) : 0.0;
  return out;
}

Vec6 minimum_of(const QuadraticModel& model, const Determination& determination, const Vec6& x0) {
  if (determination.rank == 0) return x0;
  const bool whole = determination.rank == 6 && determination.locked == 0;
  const Mat6& p = determination.projector;
  // Where every direction is determined, the projector is the unit matrix.
  const auto projected = [&](const Mat6& m) { return whole ? m : Mat6(p * m * p + (Mat6::Identity() - p)); };
  const auto step = [&](const Cholesky& factor, const Vec6& gradient) {
    return whole ? factor.solve(gradient) : Vec6(p * factor.solve(p * gradient));
  };
  const Mat6 hessian = model.gauss + model.bend;
  const Vec6 gradient = model.gradient + hessian * x0;
  const Cholesky newton(projected(hessian));
  if (newton.positive_definite()) return x0 - step(newton, gradient);
  const Cholesky gauss(projected(model.gauss));
  return gauss.positive_definite() ? Vec6(x0 - step(gauss, gradient)) : x0;
}

Mat6 unit_covariance(const QuadraticModel& model, const Determination& determination, double ridge) {
  const Mat6& unlocked = determination.unlocked;
  const Mat6 rest = ridge * (Mat6::Identity() - determination.projector);
  if (determination.locked == 0) {
    const Cholesky information(model.gauss + rest);
    return information.positive_definite() ? information.inverse() : Mat6(Mat6::Identity() / ridge);
  }
  const Cholesky information(unlocked * model.gauss * unlocked + rest);
  return information.positive_definite() ? Mat6(unlocked * information.inverse() * unlocked) : Mat6(unlocked / ridge);
}

Mat6 pose_covariance(const Mat6& covariance_of_x, const Pose& pose, const MotionFrame& frame) {
  // w = x_w / L; dt = s + w x (t - pivot).
  const Vec3 arm = pose.translation - frame.pivot;
  Mat6 map = Mat6::Identity();
  map.topLeftCorner<3, 3>() /= frame.length;
  map.bottomLeftCorner<3, 3>() = -cross_matrix(arm) / frame.length;
  Mat6 covariance = map * covariance_of_x * map.transpose();
  // Along locked directions nothing but rounding is left, which may be negative.
  for (int k = 0; k < 6; ++k) covariance(k, k) = std::max(0.0, covariance(k, k));
  return covariance;
}

}  // namespace bladefit
