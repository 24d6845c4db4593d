#pragma once
#include "core/algebra/matrix.hpp"

namespace bladefit {

/// Cholesky factor L L' of a symmetric positive definite N x N matrix, N = 6 or 8. Eigen's own decompositions refer to
/// the heap even at fixed sizes, which core/ may not.
template <int N>
class CholeskyFactor {
 public:
  using Vector = Eigen::Matrix<double, N, 1, Eigen::DontAlign>;
  using Matrix = Eigen::Matrix<double, N, N, Eigen::DontAlign>;

  explicit CholeskyFactor(const Matrix& matrix);
  /// False: the matrix is not positive definite, and nothing below must be used.
  [[nodiscard]] bool positive_definite() const { return positive_definite_; }
  /// L^-1 b.
  [[nodiscard]] Vector solve_lower(const Vector& b) const;
  /// L'^-1 b.
  [[nodiscard]] Vector solve_upper(const Vector& b) const;
  [[nodiscard]] Vector solve(const Vector& b) const { return solve_upper(solve_lower(b)); }
  [[nodiscard]] Matrix inverse() const;

 private:
  Matrix l_ = Matrix::Zero();
  bool positive_definite_ = true;
};

using Cholesky = CholeskyFactor<6>;

}  // namespace bladefit
