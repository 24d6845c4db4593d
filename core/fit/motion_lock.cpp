#include "core/fit/motion_lock.hpp"

#include <Eigen/Geometry>

namespace bladefit {
namespace {

/// A direction that is shorter than this once the others are taken out of it is one of them.
constexpr double kDependent = 1e-6;

/// Adds what is new in `direction` to the first `count` columns. Twice, so that they are orthogonal to rounding.
void add_direction(Mat6& columns, int& count, const Vec6& direction) {
  Vec6 rest = direction.normalized();
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < count; ++k) rest -= columns.col(k).dot(rest) * columns.col(k);
    if (rest.norm() < kDependent) return;
    rest.normalize();
  }
  columns.col(count++) = rest;
}

/// x of a turn about `axis` through the origin of the machine's coordinates, which leaves t as it is.
Vec6 turn(const Vec3& axis, const Pose& pose, const MotionFrame& frame) {
  Vec6 x;
  x.head<3>() = frame.length * axis;
  x.tail<3>() = -axis.cross(pose.translation - frame.pivot);
  return x;
}

}  // namespace

Mat6 MotionBasis::projector() const {
  Mat6 out = Mat6::Zero();
  for (int k = 0; k < free; ++k) out += directions.col(k) * directions.col(k).transpose();
  return out;
}

MotionBasis free_motions(const Pose& pose, std::uint8_t locked, const MotionFrame& frame) {
  MotionBasis basis;
  if (locked == 0) return basis;
  const EulerAngles e = euler_angles(pose.rotation);
  const Vec3 axes[3] = {Vec3::UnitX(), rotation_of({e.psi, 0, 0}) * Vec3::UnitY(),
                        rotation_of({e.psi, e.theta, 0}) * Vec3::UnitZ()};
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    if ((locked & (kLockTx << k)) == 0) add_direction(basis.directions, count, Vec6::Unit(3 + k));
  }
  for (int k = 0; k < 3; ++k) {
    if ((locked & (kLockRx << k)) == 0) add_direction(basis.directions, count, turn(axes[k], pose, frame));
  }
  basis.free = count;
  for (int k = 0; k < 6 && count < 6; ++k) add_direction(basis.directions, count, Vec6::Unit(k));
  return basis;
}

Pose held(const Pose& pose, const Pose& start, std::uint8_t locked) {
  if (locked == 0) return pose;
  Pose out = pose;
  for (int k = 0; k < 3; ++k) {
    if ((locked & (kLockTx << k)) != 0) out.translation[k] = start.translation[k];
  }
  if ((locked & (kLockRx | kLockRy | kLockRz)) == 0) return out;
  EulerAngles e = euler_angles(pose.rotation);
  const EulerAngles fixed = euler_angles(start.rotation);
  if ((locked & kLockRx) != 0) e.psi = fixed.psi;
  if ((locked & kLockRy) != 0) e.theta = fixed.theta;
  if ((locked & kLockRz) != 0) e.phi = fixed.phi;
  out.rotation = rotation_of(e);
  return out;
}

}  // namespace bladefit
