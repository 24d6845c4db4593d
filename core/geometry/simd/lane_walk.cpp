#include "core/geometry/simd/lane_form.hpp"
// After it:
#include "core/geometry/surface/span_newton.hpp"

namespace bladefit {
namespace {

/// The surface of all lanes with its derivatives in the parameters of the forms.
struct Surfaces {
  Four3 s, s_u, s_v, s_uu, s_uv, s_vv;
};

BLADEFIT_INLINE Surfaces surfaces(const LaneWalk& walk, const Four& x, const Four& y) {
  const Form f[kLanes] = {evaluate(walk.taylor[0], x[0], y[0]), evaluate(walk.taylor[1], x[1], y[1]),
                          evaluate(walk.taylor[2], x[2], y[2]), evaluate(walk.taylor[3], x[3], y[3])};
  Four w, w_u, w_v, w_uu, w_uv, w_vv;
  Surfaces p;
  p.s = transposed(f[0].a, f[1].a, f[2].a, f[3].a, w);
  p.s_u = transposed(f[0].a_u, f[1].a_u, f[2].a_u, f[3].a_u, w_u);
  p.s_v = transposed(f[0].a_v, f[1].a_v, f[2].a_v, f[3].a_v, w_v);
  p.s_uu = transposed(f[0].a_uu, f[1].a_uu, f[2].a_uu, f[3].a_uu, w_uu);
  p.s_uv = transposed(f[0].a_uv, f[1].a_uv, f[2].a_uv, f[3].a_uv, w_uv);
  p.s_vv = transposed(f[0].a_vv, f[1].a_vv, f[2].a_vv, f[3].a_vv, w_vv);
  const Four inverse = 1.0 / w;
  p.s = inverse * p.s;
  p.s_u = inverse * (p.s_u - w_u * p.s);
  p.s_v = inverse * (p.s_v - w_v * p.s);
  p.s_uu = inverse * (p.s_uu - (2.0 * w_u) * p.s_u - w_uu * p.s);
  p.s_uv = inverse * (p.s_uv - w_u * p.s_v - w_v * p.s_u - w_uv * p.s);
  p.s_vv = inverse * (p.s_vv - (2.0 * w_v) * p.s_v - w_vv * p.s);
  return p;
}

}  // namespace

void walk_lanes(LaneWalk& walk) {
  Four x = load(walk.x), y = load(walk.y), before = Four{} + __builtin_inf(), found_x = x, found_y = y;
  const Four3 r = load3(walk.r);
  Mask open = x == x, converged = x != x;
  Surfaces found{};
  for (int k = 0; k < kMaxNewtonSteps && !none(open); ++k) {
    const Surfaces p = surfaces(walk, x, y);
    const Four3 offset = r - p.s;
    const Four square = dot(offset, offset);
    const Mask rises = square > before;
    if (!none(open & rises)) open = open & ~(rises & (square > before + walk.slack * (root(before) + walk.slack)));
    before = square;
    const Four m_uu = dot(p.s_u, p.s_u), m_uv = dot(p.s_u, p.s_v), m_vv = dot(p.s_v, p.s_v);
    const Four g_u = -dot(offset, p.s_u), g_v = -dot(offset, p.s_v);
    const Four h_uu = m_uu - dot(offset, p.s_uu), h_uv = m_uv - dot(offset, p.s_uv), h_vv = m_vv - dot(offset, p.s_vv);
    const Four det = h_uu * h_vv - h_uv * h_uv;
    open = open & (h_uu > 0.0) & (det > kConvexDeterminant * m_uu * m_vv);
    const Four inverse = 1.0 / det;
    const Four dx = -(h_vv * g_u - h_uv * g_v) * inverse, dy = -(h_uu * g_v - h_uv * g_u) * inverse;
    x = open ? x + dx : x;
    y = open ? y + dy : y;
    open = open & (x >= -0.5) & (x <= 0.5) & (y >= -0.5) & (y <= 0.5);
    const Mask last = dx * dx * m_uu + 2.0 * dx * dy * m_uv + dy * dy * m_vv <= walk.last_step * walk.last_step;
    const Mask done = open & last;
    open = open & ~last;
    if (none(done)) continue;
    converged = converged | done;
    found_x = done ? x : found_x;
    found_y = done ? y : found_y;
    // The last step, by the derivatives at hand.
    keep(found.s, done, p.s + dx * p.s_u + dy * p.s_v);
    keep(found.s_u, done, p.s_u + dx * p.s_uu + dy * p.s_uv);
    keep(found.s_v, done, p.s_v + dx * p.s_uv + dy * p.s_vv);
    keep(found.s_uu, done, p.s_uu);
    keep(found.s_uv, done, p.s_uv);
    keep(found.s_vv, done, p.s_vv);
  }
  for (int k = 0; k < kLanes; ++k) walk.converged[k] = converged[k] != 0;
  store(walk.x, found_x);
  store(walk.y, found_y);
  const Four per_u = load(walk.per_u), per_v = load(walk.per_v);
  store3(walk.s, found.s);
  store3(walk.s_u, per_u * found.s_u);
  store3(walk.s_v, per_v * found.s_v);
  store3(walk.s_uu, (per_u * per_u) * found.s_uu);
  store3(walk.s_uv, (per_u * per_v) * found.s_uv);
  store3(walk.s_vv, (per_v * per_v) * found.s_vv);
  store3(walk.offset, r - found.s);
}

}  // namespace bladefit
