// Poses, rows and the quadratic model, against differences and Eigen's own solvers.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/algebra/cholesky.hpp"
#include "core/algebra/symmetric_eigen.hpp"
#include "core/fit/pose_solver.hpp"
#include "tests/support/random_places.hpp"
#include "tests/unit/core/random_matrices.hpp"

namespace bladefit::testing {
namespace {

constexpr double kPi = std::numbers::pi;

RC_GTEST_PROP(Pose, ExponentialIsTheTurnAboutItsAxis, ()) {
  std::mt19937_64 random = drawn();
  const double angle = std::pow(10.0, uniform(random, -12, 0)) * kPi;
  const Vec3 axis = random_direction_in_space(random);
  const Mat3 c = rotation_exp(angle * axis);
  RC_ASSERT(largest(c.transpose() * c - Mat3::Identity()) < 1e-15);
  const Mat3 expected = Eigen::AngleAxisd(angle, Eigen::Vector3d(axis)).toRotationMatrix();
  RC_ASSERT(largest(c - expected) < 2e-15);
  RC_ASSERT((rotation_log(c) - angle * axis).norm() < 1e-14 + (angle > 3.14 ? 1e-6 : 0.0));
  RC_ASSERT(rotation_log(c).norm() <= kPi * (1.0 + 1e-15));
}

TEST(Pose, LogarithmAtHalfATurn) {
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ()), Vec3(0.6, 0.0, -0.8)}) {
    const Vec3 w = rotation_log(rotation_exp(kPi * axis));
    EXPECT_NEAR(w.norm(), kPi, 1e-14);
    EXPECT_NEAR(std::abs(w.dot(axis)), kPi, 1e-14);
  }
  EXPECT_EQ(rotation_log(Mat3::Identity()), Vec3(Vec3::Zero()));
}

/// Thesis 3-10 and 3-11, written out.
RC_GTEST_PROP(Pose, EulerAnglesGiveTheMatrixOfTheThesis, ()) {
  std::mt19937_64 random = drawn();
  const double psi = uniform(random, -kPi, kPi), theta = uniform(random, -kPi / 2, kPi / 2),
               phi = uniform(random, -kPi, kPi);
  const double cp = std::cos(psi), sp = std::sin(psi), ct = std::cos(theta), st = std::sin(theta), cf = std::cos(phi),
               sf = std::sin(phi);
  Mat3 c;
  c << ct * cf, -ct * sf, st, cp * sf + sp * st * cf, cp * cf - sp * st * sf, -sp * ct, sp * sf - cp * st * cf,
      sp * cf + cp * st * sf, cp * ct;
  RC_ASSERT(largest(rotation_of({psi, theta, phi}) - c) < 2e-15);  // of 3,000,000 one in 75,000 is above 1e-15
  const EulerAngles back = euler_angles(c);
  RC_ASSERT(largest(rotation_of(back) - c) < 1e-14);
  RC_ASSERT(std::abs(back.theta - theta) < 1e-7);
}

TEST(Pose, EulerAnglesWhereOnlyTheSumIsDetermined) {
  for (const double theta : {kPi / 2, -kPi / 2}) {
    for (const double psi : {-3.0, -1.0, 0.0, 0.5, 2.5}) {
      const Mat3 c = rotation_of({psi, theta, 0.7});
      const EulerAngles angles = euler_angles(c);
      EXPECT_LT(largest(rotation_of(angles) - c), 1e-11);
      EXPECT_NEAR(std::abs(angles.theta), kPi / 2, 1e-7);
    }
  }
}

Pose random_pose(std::mt19937_64& random, double angle, double length) {
  return {rotation_exp(angle * random_direction_in_space(random)), length * random_direction_in_space(random)};
}

RC_GTEST_PROP(Pose, StepBetweenUndoesMoved, ()) {
  std::mt19937_64 random = drawn();
  const Pose from = random_pose(random, uniform(random, 0, 3), 100);
  const Vec3 pivot = 200.0 * random_direction_in_space(random);
  Vec6 step;
  step << uniform(random, 0, 3) * random_direction_in_space(random), 10.0 * random_direction_in_space(random);
  const Pose to = moved(from, step, pivot);
  RC_ASSERT((step_between(from, to, pivot) - step).norm() < 1e-12 * (1.0 + pivot.norm()));
  const Vec3 r = apply(from, Vec3(10, -20, 30));
  const Vec3 expected = pivot + rotation_exp(step.head<3>()) * (r - pivot) + step.tail<3>();
  RC_ASSERT((apply(to, Vec3(10, -20, 30)) - expected).norm() < 1e-12 * pivot.norm());
}

/// Thousands of moves leave the rotation orthogonal to rounding.
TEST(Pose, ManyMovesStayOrthogonal) {
  std::mt19937_64 random(5);
  Pose pose;
  Vec6 step;
  for (int k = 0; k < 20000; ++k) {
    step << 0.1 * random_vector(random), random_vector(random);
    pose = moved(pose, step, Vec3(1, 2, 3));
  }
  EXPECT_LT(largest(pose.rotation.transpose() * pose.rotation - Mat3::Identity()), 1e-15);
}

/// Rows of an artificial problem, of which the last `6 - rank` directions of a random basis are not determined.
QuadraticModel random_model(std::mt19937_64& random, int rank, Mat6& basis, double bend) {
  basis = symmetric_eigen(random_symmetric(random, 100)).vectors;
  QuadraticModel model;
  for (int k = 0; k < 30; ++k) {
    Vec6 inner = Vec6::NullaryExpr([&] { return uniform(random, -1, 1); });
    inner.tail(6 - rank).setZero();
    const Mat6 b = basis * random_symmetric(random, 10) * basis.transpose();
    const DistanceRow row{uniform(random, -1, 1), basis * inner, bend * b};
    model.add(row, Vec6::Zero(), 1.0, loss_terms(Loss::none, 1.0, row.distance));
  }
  return model;
}

RC_GTEST_PROP(PoseSolver, MinimumIsThatOfTheDenseSystem, ()) {
  std::mt19937_64 random = drawn();
  Mat6 basis;
  const QuadraticModel model = random_model(random, 6, basis, 0.01);
  const Determination determination = determine(model, spectrum_of(model), 1e-9);
  RC_ASSERT(determination.rank == 6U);
  const Vec6 x0 = Vec6::NullaryExpr([&] { return uniform(random, -1, 1); });
  const Vec6 x = minimum_of(model, determination, x0);
  const Eigen::MatrixXd hessian = model.gauss + model.bend;
  const Eigen::VectorXd expected = hessian.ldlt().solve(-model.gradient);
  RC_ASSERT((x - expected).norm() < 1e-11 * (1.0 + expected.norm()));
  RC_ASSERT(model.value_at(x) <= model.value_at(x0));
}

RC_GTEST_PROP(PoseSolver, DoesNotMoveWhereNothingIsDetermined, ()) {
  std::mt19937_64 random = drawn();
  const int rank = static_cast<int>(random() % 6);
  Mat6 basis;
  const QuadraticModel model = random_model(random, rank, basis, 0.0);
  const Determination determination = determine(model, spectrum_of(model), 1e-9);
  RC_ASSERT(static_cast<int>(determination.rank) == rank);
  const Vec6 x0 = Vec6::NullaryExpr([&] { return uniform(random, -1, 1); });
  const Vec6 x = minimum_of(model, determination, x0);
  RC_ASSERT((basis.transpose() * (x - x0)).tail(6 - rank).norm() < 1e-12);
  const Vec6 gradient = model.gradient + model.gauss * x;
  RC_ASSERT((basis.transpose() * gradient).head(rank).norm() < 1e-10);
  RC_ASSERT((determination.projector * determination.free_directions).norm() < 1e-12);
}

/// A saddle of the exact Hessian: Gauss-Newton takes over, so that the step still descends.
RC_GTEST_PROP(PoseSolver, DescendsWhereTheExactHessianIsIndefinite, ()) {
  std::mt19937_64 random = drawn();
  Mat6 basis;
  QuadraticModel model = random_model(random, 6, basis, 0.0);
  const Vec6 direction = Vec6::NullaryExpr([&] { return uniform(random, -1, 1); }).normalized();
  model.bend = -100.0 * direction * direction.transpose();
  RC_ASSERT(!Cholesky(model.gauss + model.bend).positive_definite());
  const Vec6 step = minimum_of(model, determine(model, spectrum_of(model), 1e-9), Vec6::Zero());
  RC_ASSERT(step.dot(model.gradient) < 0.0);
}

RC_GTEST_PROP(PoseSolver, CovarianceIsTheInverse, ()) {
  std::mt19937_64 random = drawn();
  Mat6 basis;
  const QuadraticModel model = random_model(random, 6, basis, 0.0);
  const Mat6 covariance = unit_covariance(model, determine(model, spectrum_of(model), 1e-9), 1.0);
  RC_ASSERT(largest(covariance - Eigen::MatrixXd(model.gauss).inverse()) < 1e-10 * largest(covariance));
}

/// The covariance of (w, dt) about the origin is that of the perturbation of the pose itself.
RC_GTEST_PROP(PoseSolver, PoseCovarianceFollowsTheDefinition, ()) {
  std::mt19937_64 random = drawn();
  const MotionFrame frame{100.0 * random_direction_in_space(random), 150.0};
  const Pose pose = random_pose(random, 1.0, 50.0);
  const Mat6 covariance = random_symmetric(random, 100);
  Eigen::MatrixXd map(6, 6);  // d(w, dt)/dx by differences
  const double h = 1e-4;
  for (int k = 0; k < 6; ++k) {
    const auto perturbed = [&](double x) {
      const Pose other = moved(pose, Vec6(x * Vec6::Unit(k)), frame);
      Vec6 out;
      out << rotation_log(other.rotation * pose.rotation.transpose()), other.translation - pose.translation;
      return out;
    };
    map.col(k) = (perturbed(h) - perturbed(-h)) / (2.0 * h);
  }
  const Mat6 expected = map * covariance * map.transpose();
  RC_ASSERT(largest(pose_covariance(covariance, pose, frame) - expected) < 1e-7 * largest(expected));
}

}  // namespace
}  // namespace bladefit::testing
