#pragma once

#include <cmath>
#include <cstdint>

#include "core/geometry/taylor.hpp"

namespace bladefit::testing {

/// The k-th derivative of the i-th Bernstein polynomial of degree n, by the definition.
inline long double bernstein(int n, int i, int k, long double x) {
  if (n < 0 || i < 0 || i > n) return 0.0L;
  if (k > 0) return n * (bernstein(n - 1, i - 1, k - 1, x) - bernstein(n - 1, i, k - 1, x));
  long double value = 1.0L;
  for (int j = 1; j <= i; ++j) value *= static_cast<long double>(n - i + j) / j;
  return value * std::pow(x, static_cast<long double>(i)) * std::pow(1.0L - x, static_cast<long double>(n - i));
}

/// A control net at (s, t) in 0..1 with its derivatives, as sums of Bernstein polynomials in extended precision: slow,
/// and by another way than the core.
inline HomogeneousDerivatives bernstein_sum(const double* net, std::uint32_t degree_u, std::uint32_t degree_v, double s,
                                            double t) {
  const int p = static_cast<int>(degree_u), q = static_cast<int>(degree_v);
  const auto sum = [&](int along_u, int along_v) {
    Eigen::Array<long double, 4, 1> value = Eigen::Array<long double, 4, 1>::Zero();
    for (int i = 0; i <= p; ++i) {
      for (int j = 0; j <= q; ++j) {
        const Eigen::Map<const Homogeneous> point(net + 4 * (i * (q + 1) + j));
        value += bernstein(p, i, along_u, s) * bernstein(q, j, along_v, t) * point.cast<long double>();
      }
    }
    return Homogeneous(value.cast<double>());
  };
  return {sum(0, 0), sum(1, 0), sum(0, 1), sum(2, 0), sum(1, 1), sum(0, 2)};
}

}  // namespace bladefit::testing
