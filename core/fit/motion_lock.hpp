#pragma once
#include <cstdint>

#include "core/fit/motion_frame.hpp"

namespace bladefit {

/// Degrees of freedom of the motion: bits of a set. Translations t and rotations C = Rx(psi) Ry(theta) Rz(phi) of
/// r = C R + t, so that rx holds psi, ry theta and rz phi.
inline constexpr std::uint8_t kLockTx = 1, kLockTy = 2, kLockTz = 4, kLockRx = 8, kLockRy = 16, kLockRz = 32;
inline constexpr std::uint8_t kLockAll = 63;

/// Directions of x at a pose: orthonormal columns, those that keep the locked degrees of freedom first.
struct MotionBasis {
  Mat6 directions = Mat6::Identity();
  int free = 6;
  /// Onto the first `free` columns.
  [[nodiscard]] Mat6 projector() const;
};

/// To first order in x. At theta = +-pi/2, where psi and phi turn about the same axis, one direction is lost.
/// Cost: two passes of Gram and Schmidt over 6 x 6.
[[nodiscard]] MotionBasis free_motions(const Pose& pose, std::uint8_t locked, const MotionFrame& frame);

/// `pose` with the locked degrees of freedom of `start`.
[[nodiscard]] Pose held(const Pose& pose, const Pose& start, std::uint8_t locked);

}  // namespace bladefit
