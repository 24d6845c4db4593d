#include "core/geometry/distance_certificate.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

constexpr std::size_t kMaxProductOrder = 2 * kMaxDegree + 1;

constexpr auto make_binomials() {
  std::array<std::array<double, kMaxProductOrder>, kMaxProductOrder> table{};
  for (std::size_t n = 0; n < kMaxProductOrder; ++n) {
    table[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) table[n][k] = table[n - 1][k - 1] + (k < n ? table[n - 1][k] : 0.0);
  }
  return table;
}
constexpr auto kBinomial = make_binomials();

/// Bernstein coefficients of a scalar polynomial of degree (m, n), row by row in u.
struct ScalarNet {
  std::uint32_t m, n;
  std::array<double, kMaxProductOrder * kMaxProductOrder> c;
  [[nodiscard]] double at(std::uint32_t k, std::uint32_t l) const { return c[k * (n + 1) + l]; }
};

/// Net scaled with the binomials, moved to the origin r; the fourth component is bound * w.
template <std::uint32_t DegreeU, std::uint32_t DegreeV>
void square_net(const BezierNet& net, const Vec3& r, double bound, ScalarNet& g) {
  const std::uint32_t p = DegreeU != 0 ? DegreeU : net.degree_u, q = DegreeV != 0 ? DegreeV : net.degree_v;
  std::array<Homogeneous, kMaxOrder * kMaxOrder> a;
  const Homogeneous origin(r[0], r[1], r[2], 1.0 - bound);
  for (std::uint32_t i = 0; i <= p; ++i) {
    for (std::uint32_t j = 0; j <= q; ++j) {
      const Homogeneous& point = net.at(i, j);
      a[i * (q + 1) + j] = (kBinomial[p][i] * kBinomial[q][j]) * (point - point[3] * origin);
    }
  }
  g.m = 2 * p;
  g.n = 2 * q;
  const std::uint32_t columns = 2 * q + 1;
  std::fill_n(g.c.begin(), (2 * p + 1) * columns, 0.0);
  for (std::uint32_t i = 0; i <= p; ++i) {
    for (std::uint32_t k = i; k <= p; ++k) {
      const double twice = k > i ? 2.0 : 1.0;
      double* row = &g.c[(i + k) * columns];
      for (std::uint32_t j = 0; j <= q; ++j) {
        Homogeneous left = twice * a[i * (q + 1) + j];
        left[3] = -left[3];
        for (std::uint32_t l = 0; l <= q; ++l) row[j + l] += (left * a[k * (q + 1) + l]).sum();
      }
    }
  }
  for (std::uint32_t k = 0; k <= g.m; ++k) {
    for (std::uint32_t l = 0; l <= g.n; ++l) g.c[k * columns + l] /= kBinomial[g.m][k] * kBinomial[g.n][l];
  }
}

/// Sylvester's criterion from the extreme second differences of the coefficients.
bool strictly_convex(const ScalarNet& g) {
  double least_uu = INFINITY, least_vv = INFINITY, most_uv = 0.0;
  const auto m = static_cast<double>(g.m), n = static_cast<double>(g.n);
  for (std::uint32_t k = 0; k + 2 <= g.m; ++k) {
    for (std::uint32_t l = 0; l <= g.n; ++l)
      least_uu = std::min(least_uu, g.at(k, l) - 2.0 * g.at(k + 1, l) + g.at(k + 2, l));
  }
  if (!(least_uu > 0.0)) return false;
  for (std::uint32_t k = 0; k <= g.m; ++k) {
    for (std::uint32_t l = 0; l + 2 <= g.n; ++l)
      least_vv = std::min(least_vv, g.at(k, l) - 2.0 * g.at(k, l + 1) + g.at(k, l + 2));
  }
  if (!(least_vv > 0.0)) return false;
  for (std::uint32_t k = 0; k + 1 <= g.m; ++k) {
    for (std::uint32_t l = 0; l + 1 <= g.n; ++l)
      most_uv = std::max(most_uv, std::abs(g.at(k + 1, l + 1) - g.at(k, l + 1) - g.at(k + 1, l) + g.at(k, l)));
  }
  return m * (m - 1.0) * least_uu * n * (n - 1.0) * least_vv > m * m * n * n * most_uv * most_uv * (1.0 + 1e-9);
}

}  // namespace

bool beyond_plane(const BezierNet& net, const Vec3& r, double bound) {
  const std::uint32_t count = (net.degree_u + 1) * (net.degree_v + 1);
  const Homogeneous origin(r[0], r[1], r[2], 0.0);
  Homogeneous middle =
      net.at(0, 0) + net.at(0, net.degree_v) + net.at(net.degree_u, 0) + net.at(net.degree_u, net.degree_v);
  middle -= middle[3] * origin;
  const double length = std::sqrt(middle.head<3>().square().sum());
  if (!(length > 0.0)) return false;
  Homogeneous direction = middle / length;
  direction[3] = -(bound + (direction * origin).sum());
  for (std::uint32_t k = 0; k < count; ++k) {
    if ((direction * net.points[k]).sum() < 0.0) return false;
  }
  return true;
}

DistanceCertificate certify_distance(const BezierNet& net, const Vec3& r, double bound, double tolerance) {
  ScalarNet g;
  if (net.degree_u == 3 && net.degree_v == 3) {
    square_net<3, 3>(net, r, bound, g);
  } else {
    square_net<0, 0>(net, r, bound, g);
  }
  const std::uint32_t count = (g.m + 1) * (g.n + 1);
  const double least = *std::min_element(g.c.begin(), g.c.begin() + count);
  double least_weight = INFINITY;
  for (std::uint32_t k = 0; k < (net.degree_u + 1) * (net.degree_v + 1); ++k)
    least_weight = std::min(least_weight, net.points[k][3]);
  DistanceCertificate certificate;
  certificate.farther = least >= -tolerance * least_weight * least_weight;
  certificate.convex = !certificate.farther && strictly_convex(g);
  return certificate;
}

}  // namespace bladefit
