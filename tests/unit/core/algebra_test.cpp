// The small linear algebra, against Eigen's own solvers.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/algebra/cholesky.hpp"
#include "core/algebra/symmetric_eigen.hpp"
#include "tests/support/random_places.hpp"
#include "tests/unit/core/random_matrices.hpp"

namespace bladefit::testing {
namespace {

RC_GTEST_PROP(SymmetricEigen, AgreesWithEigen, ()) {
  std::mt19937_64 random = drawn();
  Mat6 m = random_symmetric(random, 1e6);
  if (random() % 2 == 0) m -= 0.1 * Mat6::Identity();
  if (random() % 4 == 0) m.row(2).setZero(), m.col(2).setZero();
  const SymmetricEigen mine = symmetric_eigen(m);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> theirs{Eigen::MatrixXd(m)};
  RC_ASSERT((mine.values - theirs.eigenvalues()).norm() < 1e-14);
  RC_ASSERT(largest(mine.vectors.transpose() * mine.vectors - Mat6::Identity()) < 1e-14);
  RC_ASSERT(largest(m * mine.vectors - mine.vectors * mine.values.asDiagonal()) < 1e-14);
}

TEST(SymmetricEigen, ZeroAndDiagonalMatrices) {
  EXPECT_EQ(symmetric_eigen(Mat6::Zero()).values, Vec6(Vec6::Zero()));
  Vec6 diagonal;
  diagonal << 3, 1e-30, 2, -5, 1e30, 0;
  const SymmetricEigen eigen = symmetric_eigen(Mat6(diagonal.asDiagonal()));
  EXPECT_EQ(eigen.values[0], -5.0);
  EXPECT_EQ(eigen.values[5], 1e30);
}

RC_GTEST_PROP(Cholesky, AgreesWithEigen, ()) {
  std::mt19937_64 random = drawn();
  const Mat6 m = random_symmetric(random, 1e4);
  const Vec6 b = Vec6::NullaryExpr([&] { return uniform(random, -1, 1); });
  const Cholesky mine(m);
  RC_ASSERT(mine.positive_definite());
  const Eigen::LLT<Eigen::MatrixXd> theirs{Eigen::MatrixXd(m)};
  const Eigen::VectorXd expected = theirs.solve(b);
  RC_ASSERT((mine.solve(b) - expected).norm() < 1e-10 * expected.norm());
  RC_ASSERT(largest(mine.inverse() * m - Mat6::Identity()) < 1e-10);
}

RC_GTEST_PROP(Cholesky, RefusesWhatIsNotPositiveDefinite, ()) {
  std::mt19937_64 random = drawn();
  Mat6 m = random_symmetric(random, 10);
  const Vec6 v = Vec6::NullaryExpr([&] { return uniform(random, -1, 1); }).normalized();
  m -= (v.dot(m * v) + 0.01) * v * v.transpose();
  RC_ASSERT(!Cholesky(m).positive_definite());
  m(3, 3) = NAN;
  RC_ASSERT(!Cholesky(m).positive_definite());
  RC_ASSERT(!Cholesky(Mat6::Zero()).positive_definite());
}

}  // namespace
}  // namespace bladefit::testing
