#include "core/geometry/span_newton.hpp"

#include <cmath>

namespace bladefit {
namespace {

constexpr int kMaxSteps = 12;

[[gnu::always_inline]] inline double dot(const Homogeneous& a, const Homogeneous& b) {
  const Homogeneous c = a * b;
  return c[0] + c[1] + c[2];
}

/// The last step, by the derivatives at hand.
void finish(const HomogeneousDerivatives& h, double dx, double dy, SpanFoot& foot) {
  const Homogeneous s = h.a + dx * h.a_u + dy * h.a_v;
  const Homogeneous s_u = h.a_u + dx * h.a_uu + dy * h.a_uv;
  const Homogeneous s_v = h.a_v + dx * h.a_uv + dy * h.a_vv;
  foot.at = {s.head<3>(), s_u.head<3>(), s_v.head<3>(), h.a_uu.head<3>(), h.a_uv.head<3>(), h.a_vv.head<3>()};
}

}  // namespace

SpanEnd newton_in_span(const SpanTask& task, SpanFoot& foot) {
  const Homogeneous r(task.r[0], task.r[1], task.r[2], 1.0);
  double x = foot.x, y = foot.y;
  for (int k = 0; k < kMaxSteps; ++k) {
    HomogeneousDerivatives h;
    evaluate_taylor(task.taylor, task.degree_u, task.degree_v, x, y, h);
    project(h);
    const Homogeneous offset = r - h.a;
    const double square = dot(offset, offset);
    if (square > foot.distance_squared &&
        square > foot.distance_squared + task.slack * (std::sqrt(foot.distance_squared) + task.slack))
      return SpanEnd::stuck;
    foot.x = x;
    foot.y = y;
    foot.distance_squared = square;
    foot.moved = true;
    const double g_u = -dot(offset, h.a_u), g_v = -dot(offset, h.a_v);
    const double m_uu = dot(h.a_u, h.a_u), m_uv = dot(h.a_u, h.a_v), m_vv = dot(h.a_v, h.a_v);
    const double h_uu = m_uu - dot(offset, h.a_uu), h_uv = m_uv - dot(offset, h.a_uv);
    const double h_vv = m_vv - dot(offset, h.a_vv);
    const double det = h_uu * h_vv - h_uv * h_uv;
    if (!(h_uu > 0.0 && det > kConvexDeterminant * m_uu * m_vv)) return SpanEnd::stuck;
    const double inverse = 1.0 / det;
    const double dx = -(h_vv * g_u - h_uv * g_v) * inverse, dy = -(h_uu * g_v - h_uv * g_u) * inverse;
    x += dx;
    y += dy;
    const bool inside = x >= task.x_min && x <= task.x_max && y >= task.y_min && y <= task.y_max;
    if (dx * dx * m_uu + 2.0 * dx * dy * m_uv + dy * dy * m_vv <= task.last_step * task.last_step) {
      if (!inside) return SpanEnd::stuck;
      finish(h, dx, dy, foot);
      foot.x = x;
      foot.y = y;
      return SpanEnd::converged;
    }
    if (inside) continue;
    foot.next_x = x;
    foot.next_y = y;
    return SpanEnd::left;
  }
  return SpanEnd::stuck;
}

}  // namespace bladefit
