#pragma once
#include "core/fit/motion_lock.hpp"

namespace bladefit {

/// Which directions of motion the points determine, from the eigenvalues of the information matrix sum J J'.
struct Determination {
  std::uint32_t rank = 0;               ///< determined directions, locked ones included: 0..6
  std::uint32_t locked = 0;             ///< of these, how many are locked
  double smallest = 0;                  ///< smallest eigenvalue per point, dimensionless
  Mat6 projector = Mat6::Zero();        ///< onto the determined directions that are not locked
  Mat6 unlocked = Mat6::Identity();     ///< projector onto all directions that are not locked
  Mat6 free_directions = Mat6::Zero();  ///< its first 6 - rank columns: unit vectors of the others
};

/// A direction counts as determined when its eigenvalue reaches `threshold`. Locked directions are those beyond the
/// free ones of `basis`. Cost: one symmetric 6 x 6 eigenproblem.
[[nodiscard]] Determination determine(const QuadraticModel& model, double threshold, const MotionBasis& basis = {});

/// Minimum of the model over x, started from x0 and moved in the determined directions only. Newton with the exact
/// Hessian where it is positive definite there, Gauss-Newton otherwise. Cost: one or two 6 x 6 Cholesky decompositions.
[[nodiscard]] Vec6 minimum_of(const QuadraticModel& model, const Determination& determination, const Vec6& x0);

/// (sum J J')^-1 with `ridge` added to every direction that is not determined: the covariance of x for unit variance, 0
/// along locked directions.
[[nodiscard]] Mat6 unit_covariance(const QuadraticModel& model, const Determination& determination, double ridge);

/// Maps a covariance of x to that of (w, dt) of C' = exp([w]x) C, t' = t + dt.
[[nodiscard]] Mat6 pose_covariance(const Mat6& covariance_of_x, const Pose& pose, const MotionFrame& frame);

}  // namespace bladefit
