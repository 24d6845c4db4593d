#pragma once
#include "core/algebra/matrix.hpp"

namespace bladefit {

/// Rigid motion machine -> design: r = rotation * R + translation [mm] (thesis 3-9).
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();
};

/// Angles of rotation = Rx(psi) Ry(theta) Rz(phi) (thesis 3-10, 3-11) [rad].
struct EulerAngles {
  double psi = 0, theta = 0, phi = 0;
};

[[nodiscard]] inline Vec3 apply(const Pose& pose, const Vec3& machine_point) {
  return pose.rotation * machine_point + pose.translation;
}

/// Euler angles of an orthogonal matrix; at theta = +-pi/2, where only psi +- phi is determined, phi is 0.
[[nodiscard]] EulerAngles euler_angles(const Mat3& rotation);

/// Rx(psi) Ry(theta) Rz(phi).
[[nodiscard]] Mat3 rotation_of(const EulerAngles& angles);

/// exp([w]x), orthogonal to rounding for every w [rad].
[[nodiscard]] Mat3 rotation_exp(const Vec3& w);

/// w with exp([w]x) = rotation, |w| <= pi.
[[nodiscard]] Vec3 rotation_log(const Mat3& rotation);

/// The pose moved by (w, s) about the point `pivot` of the design frame: r' = pivot + exp([w]x)(r - pivot) + s.
/// The rotation is made orthogonal again, so that thousands of moves do not build up rounding.
[[nodiscard]] Pose moved(const Pose& pose, const Vec6& step, const Vec3& pivot);

/// The step with moved(from, step, pivot) = to.
[[nodiscard]] Vec6 step_between(const Pose& from, const Pose& to, const Vec3& pivot);

}  // namespace bladefit
