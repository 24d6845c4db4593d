#include "tests/bench/peers/distance_model.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

namespace bladefit::bench {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// d exp([w]x) = [J dw]x exp([w]x).
Eigen::Matrix3d left_jacobian_of(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d k = cross_matrix(w);
  const bool small = angle < 1e-4;
  const double a = small ? 0.5 : (1.0 - std::cos(angle)) / (angle * angle);
  const double b = small ? 1.0 / 6.0 : (angle - std::sin(angle)) / (angle * angle * angle);
  return Eigen::Matrix3d::Identity() + a * k + b * k * k;
}

Eigen::Matrix3d rotation_of_vector(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

}  // namespace

DistanceModel::DistanceModel(const TextbookSurface& surface, int outward, const FitProblem& problem)
    : surface_(surface), outward_(outward), problem_(problem), centroid_(Eigen::Vector3d::Zero()), feet_(problem.feet) {
  const auto count = static_cast<double>(problem.points.size());
  for (const Vec3& point : problem.points) arms_.emplace_back(apply(problem.start, point));
  for (const Eigen::Vector3d& r : arms_) centroid_ += r / count;
  double square = 0.0;
  for (Eigen::Vector3d& arm : arms_) {
    arm -= centroid_;
    square += arm.squaredNorm();
  }
  length_ = std::sqrt(square / count);
  distances_.resize(static_cast<Eigen::Index>(arms_.size()));
  jacobian_.resize(distances_.size(), 6);
}

DistanceModel::Motion DistanceModel::motion_at(const double* x) const {
  const Eigen::Vector3d w = Eigen::Map<const Eigen::Vector3d>(x) / length_;
  return {rotation_of_vector(w), left_jacobian_of(w) / length_, Eigen::Map<const Eigen::Vector3d>(x + 3)};
}

void DistanceModel::evaluate(const double* x) {
  const Eigen::Map<const Vector6> asked(x);
  if (evaluated_ && asked == x_) return;
  x_ = asked;
  evaluated_ = true;
  const Motion motion = motion_at(x);
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::Vector3d arm = motion.rotation * arms_[i], r = centroid_ + motion.shift + arm;
    feet_[i] = surface_.foot(r, feet_[i]);
    const TextbookPoint p = surface_.evaluate(feet_[i]);
    const Eigen::Vector3d normal = outward_ * p.s_u.cross(p.s_v).normalized();
    distances_[row] = normal.dot(r - p.s);
    jacobian_.row(row) << arm.cross(normal).transpose() * motion.left_jacobian, normal.transpose();
  }
}

DistanceModel::Moved DistanceModel::moved_point(std::size_t i, const double* x) const {
  const Motion motion = motion_at(x);
  const Eigen::Vector3d arm = motion.rotation * arms_[i];
  Moved moved{centroid_ + motion.shift + arm, {}};
  moved.derivative << -cross_matrix(arm) * motion.left_jacobian, Eigen::Matrix3d::Identity();
  return moved;
}

/// r = c + t + Q (C R + s - c).
Pose DistanceModel::pose_at(const double* x) const {
  const Motion motion = motion_at(x);
  Pose pose;
  pose.rotation = motion.rotation * problem_.start.rotation;
  pose.translation = centroid_ + motion.shift + motion.rotation * (problem_.start.translation - centroid_);
  return pose;
}

}  // namespace bladefit::bench
