#include "core/geometry/surface/taylor.hpp"

namespace bladefit {
namespace {

/// One control polygon of n + 1 points, `stride` apart, becomes its Taylor form: c_k = binomial(n, k) times the k-th
/// differences, at the middle by de Casteljau's rule.
void expand_polygon(double* points, std::uint32_t n, std::uint32_t stride) {
  std::array<Homogeneous, kMaxOrder> differences, middle;
  const auto point = [&](std::uint32_t i) { return Eigen::Map<Homogeneous>(points + 4U * i * stride); };
  for (std::uint32_t i = 0; i <= n; ++i) differences[i] = point(i);
  double binomial = 1.0;
  for (std::uint32_t k = 0; k <= n; ++k) {
    middle = differences;
    for (std::uint32_t m = n - k; m > 0; --m) {
      for (std::uint32_t i = 0; i < m; ++i) middle[i] = 0.5 * (middle[i] + middle[i + 1]);
    }
    point(k) = binomial * middle[0];
    for (std::uint32_t i = 0; i + k < n; ++i) differences[i] = differences[i + 1] - Homogeneous(differences[i]);
    binomial = binomial * (n - k) / (k + 1);
  }
}

}  // namespace

void to_taylor_form(std::uint32_t degree_u, std::uint32_t degree_v, double* net) {
  const std::uint32_t columns = degree_v + 1;
  for (std::uint32_t j = 0; j < columns; ++j) expand_polygon(net + 4U * j, degree_u, columns);
  for (std::uint32_t i = 0; i <= degree_u; ++i) expand_polygon(net + 4U * i * columns, degree_v, 1);
}

void taylor::sum_any(const double* c, std::uint32_t degree_u, std::uint32_t degree_v, double x, double y,
                     HomogeneousDerivatives& out) {
  sum<0, 0>(c, degree_u, degree_v, x, y, out);
}

}  // namespace bladefit
