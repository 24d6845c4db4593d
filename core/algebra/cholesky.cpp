#include "core/algebra/cholesky.hpp"

#include <cmath>

namespace bladefit {

template <int N>
CholeskyFactor<N>::CholeskyFactor(const Matrix& matrix) {
  for (int j = 0; j < N; ++j) {
    double pivot = matrix(j, j);
    for (int k = 0; k < j; ++k) pivot -= l_(j, k) * l_(j, k);
    // A pivot this small against its diagonal is rounding.
    if (!(pivot > 1e-14 * matrix(j, j)) || !(matrix(j, j) > 0.0)) {
      positive_definite_ = false;
      return;
    }
    l_(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < N; ++i) {
      double sum = matrix(i, j);
      for (int k = 0; k < j; ++k) sum -= l_(i, k) * l_(j, k);
      l_(i, j) = sum / l_(j, j);
    }
  }
}

template <int N>
auto CholeskyFactor<N>::solve_lower(const Vector& b) const -> Vector {
  Vector x = b;
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= l_(i, k) * x[k];
    x[i] /= l_(i, i);
  }
  return x;
}

template <int N>
auto CholeskyFactor<N>::solve_upper(const Vector& b) const -> Vector {
  Vector x = b;
  for (int i = N - 1; i >= 0; --i) {
    for (int k = i + 1; k < N; ++k) x[i] -= l_(k, i) * x[k];
    x[i] /= l_(i, i);
  }
  return x;
}

template <int N>
auto CholeskyFactor<N>::inverse() const -> Matrix {
  Matrix out;
  for (int k = 0; k < N; ++k) out.col(k) = solve(Vector::Unit(k));
  return out;
}

template class CholeskyFactor<6>;
template class CholeskyFactor<8>;

}  // namespace bladefit
