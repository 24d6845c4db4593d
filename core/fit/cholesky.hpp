#pragma once
#include "core/fit/pose.hpp"

namespace bladefit {

/// Cholesky factor of a symmetric positive definite 6 x 6 matrix. Eigen's own decompositions refer to the heap even at
/// fixed sizes, which core/ may not.
class Cholesky {
 public:
  explicit Cholesky(const Mat6& matrix);
  /// False: the matrix is not positive definite, and solve() must not be used.
  [[nodiscard]] bool positive_definite() const { return positive_definite_; }
  [[nodiscard]] Vec6 solve(const Vec6& b) const;
  [[nodiscard]] Mat6 inverse() const;

 private:
  Mat6 l_ = Mat6::Zero();
  bool positive_definite_ = true;
};

}  // namespace bladefit
