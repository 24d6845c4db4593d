#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/surface/taylor.hpp"

namespace bladefit::testing {

/// Bernstein polynomials of degree n, by their recurrence.
inline std::vector<long double> bernstein(int n, long double x) {
  std::vector<long double> values{1.0L};
  for (int m = 1; m <= n; ++m) {
    values.push_back(0.0L);
    for (std::size_t i = values.size() - 1; i > 0; --i) values[i] = (1.0L - x) * values[i] + x * values[i - 1];
    values[0] *= 1.0L - x;
  }
  return values;
}

/// Their k-th derivatives: differences of the polynomials of degree n - k.
inline std::vector<long double> bernstein_derivatives(int n, int k, long double x) {
  if (k > n) return std::vector<long double>(static_cast<std::size_t>(n) + 1, 0.0L);
  std::vector<long double> values = bernstein(n - k, x);
  for (int m = n - k + 1; m <= n; ++m) {
    values.push_back(0.0L);
    for (std::size_t i = values.size() - 1; i > 0; --i) values[i] = m * (values[i - 1] - values[i]);
    values[0] *= -m;
  }
  return values;
}

/// A control net at (s, t) in 0..1 with its derivatives, as sums of Bernstein polynomials in extended precision: slow,
/// and by another way than the core.
inline HomogeneousDerivatives bernstein_sum(const double* net, std::uint32_t degree_u, std::uint32_t degree_v, double s,
                                            double t) {
  const auto sum = [&](int along_u, int along_v) {
    const std::vector<long double> of_u = bernstein_derivatives(static_cast<int>(degree_u), along_u, s);
    const std::vector<long double> of_v = bernstein_derivatives(static_cast<int>(degree_v), along_v, t);
    Eigen::Array<long double, 4, 1> value = Eigen::Array<long double, 4, 1>::Zero();
    const double* point = net;
    for (const long double a : of_u) {
      for (const long double b : of_v) {
        value += a * b * Eigen::Map<const Homogeneous>(point).cast<long double>();
        point += 4;
      }
    }
    return Homogeneous(value.cast<double>());
  };
  return {sum(0, 0), sum(1, 0), sum(0, 1), sum(2, 0), sum(1, 1), sum(0, 2)};
}

}  // namespace bladefit::testing
