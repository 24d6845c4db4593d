#include "core/geometry/simd/lane_vector.hpp"

namespace bladefit {
namespace {

/// A direction in space as one of motions: Lever of quadratic_model.cpp.
struct Lever {
  Four3 arm, half_turn;
  double inverse_length;

  BLADEFIT_INLINE void operator()(const Four3& direction, Four (&out)[6]) const {
    const Four3 moment = cross(arm, direction), turned = moment + cross(moment, half_turn);
    out[0] = inverse_length * turned.x;
    out[1] = inverse_length * turned.y;
    out[2] = inverse_length * turned.z;
    out[3] = direction.x;
    out[4] = direction.y;
    out[5] = direction.z;
  }
};

BLADEFIT_INLINE Four3 broadcast(const double* a) { return {Four{} + a[0], Four{} + a[1], Four{} + a[2]}; }

/// add_surface_bend() of quadratic_model.cpp.
BLADEFIT_INLINE void surface_bend(const LaneWalk& walk, const Four3& n, const Four& phi, const Lever& lever,
                                  Four (&bend)[21]) {
  const Four3 s_u = load3(walk.s_u), s_v = load3(walk.s_v);
  const Four g_uu = eigen_dot(s_u, s_u), g_uv = eigen_dot(s_u, s_v), g_vv = eigen_dot(s_v, s_v);
  const Four b_uu = eigen_dot(n, load3(walk.s_uu)), b_uv = eigen_dot(n, load3(walk.s_uv)),
             b_vv = eigen_dot(n, load3(walk.s_vv));
  const Four m_uu = g_uu - phi * b_uu, m_uv = g_uv - phi * b_uv, m_vv = g_vv - phi * b_vv;
  const Four det = (g_uu * g_vv - g_uv * g_uv) * (m_uu * m_vv - m_uv * m_uv);
  const Four size = det < 0.0 ? -det : det;
  const Mask regular = size > 1e-24 * g_uu * g_uu * g_vv * g_vv;
  const Four x_uu = g_vv * b_uu - g_uv * b_uv, x_uv = g_vv * b_uv - g_uv * b_vv;
  const Four x_vu = g_uu * b_uv - g_uv * b_uu, x_vv = g_uu * b_vv - g_uv * b_uv;
  const Four k_uu = x_uu * m_vv - x_uv * m_uv, k_uv = x_uv * m_uu - x_uu * m_uv, k_vv = x_vv * m_uu - x_vu * m_uv;
  const Four factor = -1.0 / det;
  Four l_u[6], l_v[6];
  lever(s_u, l_u);
  lever(s_v, l_v);
  int entry = 0;
  for (int j = 0; j < 6; ++j) {
    const Four by_u = factor * (k_uu * l_u[j] + k_uv * l_v[j]), by_v = factor * (k_uv * l_u[j] + k_vv * l_v[j]);
    for (int i = 0; i <= j; ++i, ++entry) {
      const Four sum = by_u * l_u[i] + by_v * l_v[i];
      bend[entry] = regular ? sum : Four{};
    }
  }
}

/// add_rotation_bend() of quadratic_model.cpp.
BLADEFIT_INLINE void rotation_bend(const Four3& n, const Four3& arm, double length, Four (&bend)[21]) {
  const double f = 1.0 / (length * length), half = 0.5 * f;
  const Four along = f * eigen_dot(n, arm);
  const Four normal[3] = {n.x, n.y, n.z}, lever[3] = {arm.x, arm.y, arm.z};
  int entry = 0;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i <= j; ++i, ++entry) bend[entry] += half * (normal[i] * lever[j] + lever[i] * normal[j]);
    bend[entry - 1] -= along;
  }
}

}  // namespace

void take_rows(const LaneWalk& walk, const LaneFrame& frame, LaneRows& rows) {
  const Four3 s_u = load3(walk.s_u), s_v = load3(walk.s_v), offset = load3(walk.offset), normal = cross(s_u, s_v);
  const Four sizes = eigen_dot(s_u, s_u) + eigen_dot(s_v, s_v);
  const Mask regular = eigen_dot(normal, normal) > 1e-24 * sizes * sizes;
  for (int k = 0; k < kLanes; ++k) rows.regular[k] = regular[k] != 0;
  const Four3 outward = load(frame.outward) * normal;
  const Four length = root(eigen_dot(outward, outward));
  const Four3 n{outward.x / length, outward.y / length, outward.z / length};
  const Four phi = eigen_dot(n, offset);
  const Lever lever{load3(walk.r) - broadcast(frame.pivot) - broadcast(frame.x + 3),
                    (Four{} + 0.5 / frame.length) * broadcast(frame.x), 1.0 / frame.length};
  Four gradient[6], bend[21];
  lever(n, gradient);
  surface_bend(walk, n, phi, lever, bend);
  rotation_bend(n, lever.arm, frame.length, bend);
  store3(rows.normal, n);
  store(rows.distance, phi - frame.probe_radius);
  for (int k = 0; k < 6; ++k) store(rows.gradient[k], gradient[k]);
  for (int k = 0; k < 21; ++k) store(rows.bend[k], bend[k]);
}

}  // namespace bladefit
