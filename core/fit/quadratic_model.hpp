#pragma once
#include <cstdint>

#include "core/fit/loss.hpp"
#include "core/fit/motion_frame.hpp"
#include "core/geometry/nearest/local_projection.hpp"

namespace bladefit {

/// Second-order expansion of one oriented distance in the motion parameters x.
struct DistanceRow {
  double distance = 0;           ///< d [mm], less the probe radius
  Vec6 gradient = Vec6::Zero();  ///< dd/dx = [((r - pivot) x n) / L, n] (thesis 4-21)
  Mat6 bend = Mat6::Zero();      ///< d^2 d / dx^2 [1/mm]
};

/// Row of a projection at the pose that stands `x` away from the reference. `foot` is foot_of() the projection.
/// Cost: about 150 multiplications. The bend is exact at x = 0 (Weingarten's equations; an edge or corner foot has that
/// of the distance to a curve or a point); elsewhere the error is of first order in |w|.
[[nodiscard]] DistanceRow distance_row(const Projection& projection, const Foot& foot, const Vec3& r, const Vec6& x,
                                       const MotionFrame& frame);

/// Sum of w_i rho(d_i), rho = 1/2 d^2 in least squares, as a quadratic function of x about a reference pose.
struct QuadraticModel {
  Pose reference;
  Mat6 gauss = Mat6::Zero();     ///< sum w J J', each w times the loss's weight
  Mat6 bend = Mat6::Zero();      ///< the rest of the exact Hessian: in least squares sum w d * d^2 d/dx^2
  Vec6 gradient = Vec6::Zero();  ///< at x = 0
  double half_square = 0;        ///< the sum at x = 0
  double weight = 0;             ///< sum of w times the loss's weight
  std::uint32_t count = 0;

  /// Adds a row of weight w taken at `x`, with the terms of its distance.
  void add(const DistanceRow& row, const Vec6& x, double w, const LossTerms& terms);
  /// Value of the sum predicted at x, never below 0.
  [[nodiscard]] double value_at(const Vec6& x) const;
};

/// The same sums about another reference. Value and gradient are exact, but for the fourth power of the rotation
/// between them; the Hessian is so where the gradient is 0.
[[nodiscard]] QuadraticModel shifted(const QuadraticModel& model, const Pose& reference, const MotionFrame& frame);

}  // namespace bladefit
