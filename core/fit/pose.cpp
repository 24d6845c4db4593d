#include "core/fit/pose.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/algebra/cross_matrix.hpp"
#include "core/algebra/trigonometry.hpp"

namespace bladefit {
namespace {

/// One Newton step towards the nearest orthogonal matrix: the error is squared, so one is enough from rounding level.
Mat3 orthogonalised(const Mat3& m) { return m * (1.5 * Mat3::Identity() - 0.5 * (m.transpose() * m)); }

/// A turn about one of the axes, counted from 0.
Mat3 turn_about(int axis, double angle) {
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  Mat3 turn = Mat3::Identity();
  turn(next, next) = turn(last, last) = cosine(angle);
  turn(last, next) = sine(angle);
  turn(next, last) = -turn(last, next);
  return turn;
}

}  // namespace

EulerAngles euler_angles(const Mat3& c) {
  const double cos_theta = std::sqrt(c(0, 0) * c(0, 0) + c(0, 1) * c(0, 1));
  EulerAngles a;
  a.theta = angle_of(c(0, 2), cos_theta);
  if (cos_theta < 1e-12) {
    a.psi = angle_of(c(2, 1), c(1, 1));
    return a;
  }
  a.psi = angle_of(-c(1, 2), c(2, 2));
  a.phi = angle_of(-c(0, 1), c(0, 0));
  return a;
}

Mat3 rotation_of(const EulerAngles& a) { return turn_about(0, a.psi) * turn_about(1, a.theta) * turn_about(2, a.phi); }

Mat3 rotation_exp(const Vec3& w) {
  const double angle2 = w.squaredNorm();
  double a = 1.0 - angle2 / 6.0, b = 0.5 - angle2 / 24.0;  // sin(t)/t and (1 - cos t)/t^2 near 0
  if (angle2 > 1e-8) {
    const double angle = std::sqrt(angle2), half = sine(0.5 * angle);
    a = sine(angle) / angle;
    b = 2.0 * half * half / angle2;
  }
  const Mat3 k = cross_matrix(w);
  return orthogonalised(Mat3::Identity() + a * k + b * (k * k));
}

Vec3 rotation_log(const Mat3& rotation) {
  const Eigen::Matrix3d aligned = rotation;
  const Eigen::Quaterniond q(aligned);
  const Vec3 v(q.x(), q.y(), q.z());
  const double s = v.norm();
  if (s < 1e-9) return (q.w() < 0.0 ? -2.0 : 2.0) * v;
  const double angle = 2.0 * angle_of(s, std::abs(q.w()));
  return ((q.w() < 0.0 ? -angle : angle) / s) * v;
}

Pose moved(const Pose& pose, const Vec6& step, const Vec3& pivot) {
  const Mat3 turn = rotation_exp(step.head<3>());
  Pose out;
  out.rotation = orthogonalised(turn * pose.rotation);
  const Vec3 arm = pose.translation - pivot;
  out.translation = pivot + turn * arm + step.tail<3>();
  return out;
}

Vec6 step_between(const Pose& from, const Pose& to, const Vec3& pivot) {
  const Mat3 turn = to.rotation * from.rotation.transpose();
  Vec6 step;
  step.head<3>() = rotation_log(turn);
  step.tail<3>() = to.translation - pivot - turn * (from.translation - pivot);
  return step;
}

}  // namespace bladefit
