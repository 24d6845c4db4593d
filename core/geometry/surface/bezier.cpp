#include "core/geometry/surface/bezier.hpp"

namespace bladefit {
namespace {

/// Restricts one control polygon of n + 1 points, `stride` apart, to [t0, t1].
void restrict_polygon(Homogeneous* points, std::uint32_t n, std::uint32_t stride, double t0, double t1) {
  if (t0 >= 1.0) {
    for (std::uint32_t i = 0; i < n; ++i) points[i * stride] = points[n * stride];
    return;
  }
  // Right part of the cut at t0, then left part of the cut at the image of t1.
  for (std::uint32_t k = n; t0 > 0.0 && k > 0; --k) {
    for (std::uint32_t i = 0; i < k; ++i)
      points[i * stride] = (1.0 - t0) * points[i * stride] + t0 * points[(i + 1) * stride];
  }
  const double t = (t1 - t0) / (1.0 - t0);
  for (std::uint32_t k = 1; t < 1.0 && k <= n; ++k) {
    for (std::uint32_t i = n; i >= k; --i)
      points[i * stride] = (1.0 - t) * points[(i - 1) * stride] + t * points[i * stride];
  }
}

}  // namespace

void restrict_net(const LocalRect& rect, BezierNet& net) {
  const std::uint32_t columns = net.degree_v + 1;
  for (std::uint32_t j = 0; j < columns; ++j)
    restrict_polygon(&net.points[j], net.degree_u, columns, rect.s_min, rect.s_max);
  for (std::uint32_t i = 0; i <= net.degree_u; ++i)
    restrict_polygon(&net.points[i * columns], net.degree_v, 1, rect.t_min, rect.t_max);
}

}  // namespace bladefit
