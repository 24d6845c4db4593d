#include "core/fit/cholesky.hpp"

#include <cmath>

namespace bladefit {

Cholesky::Cholesky(const Mat6& matrix) {
  for (int j = 0; j < 6; ++j) {
    double pivot = matrix(j, j);
    for (int k = 0; k < j; ++k) pivot -= l_(j, k) * l_(j, k);
    // A pivot this small against its diagonal is rounding.
    if (!(pivot > 1e-14 * matrix(j, j)) || !(matrix(j, j) > 0.0)) {
      positive_definite_ = false;
      return;
    }
    l_(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 6; ++i) {
      double sum = matrix(i, j);
      for (int k = 0; k < j; ++k) sum -= l_(i, k) * l_(j, k);
      l_(i, j) = sum / l_(j, j);
    }
  }
}

Vec6 Cholesky::solve(const Vec6& b) const {
  Vec6 x = b;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= l_(i, k) * x[k];
    x[i] /= l_(i, i);
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) x[i] -= l_(k, i) * x[k];
    x[i] /= l_(i, i);
  }
  return x;
}

Mat6 Cholesky::inverse() const {
  Mat6 out;
  for (int k = 0; k < 6; ++k) out.col(k) = solve(Vec6::Unit(k));
  return out;
}

}  // namespace bladefit
