#pragma once
#include "core/algebra/symmetric_eigen.hpp"
#include "core/fit/motion_lock.hpp"
#include "core/fit/quadratic_model.hpp"

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

/// Directions of motion by how well the points determine them.
struct MotionSpectrum {
  SymmetricEigen eigen;  ///< of the information matrix; infinite values for locked directions
  Mat6 unlocked = Mat6::Identity();
  std::uint32_t locked = 0;
};

/// Locked directions are those beyond the free ones of `basis`. Cost: one symmetric 6 x 6 eigenproblem.
[[nodiscard]] MotionSpectrum spectrum_of(const QuadraticModel& model, const MotionBasis& basis = {});

/// An upper bound, at 99.5 % confidence, of the variance of a distance of weight 1 [mm^2]: of what no motion from `x`
/// by at most `reach` [mm] in each direction explains. Infinite while too few points are there to tell.
[[nodiscard]] double noise_bound(const QuadraticModel& model, const MotionSpectrum& spectrum, const Vec6& x,
                                 double reach);

/// A direction counts as determined when its eigenvalue reaches `threshold`.
[[nodiscard]] Determination determine(const QuadraticModel& model, const MotionSpectrum& spectrum, double threshold);

/// Minimum of the model over x, started from x0 and moved in the determined directions only. Newton with the exact
/// Hessian where it is positive definite there, Gauss-Newton otherwise. Cost: one or two 6 x 6 Cholesky decompositions.
[[nodiscard]] Vec6 minimum_of(const QuadraticModel& model, const Determination& determination, const Vec6& x0);

/// (sum J J')^-1 with `ridge` added to every direction that is not determined: the covariance of x for unit variance, 0
/// along locked directions.
[[nodiscard]] Mat6 unit_covariance(const QuadraticModel& model, const Determination& determination, double ridge);

/// Maps a covariance of x to that of (w, dt) of C' = exp([w]x) C, t' = t + dt.
[[nodiscard]] Mat6 pose_covariance(const Mat6& covariance_of_x, const Pose& pose, const MotionFrame& frame);

}  // namespace bladefit
