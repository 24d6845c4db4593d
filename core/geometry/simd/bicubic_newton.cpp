#include "core/geometry/simd/lane_form.hpp"
// After it:
#include "core/geometry/surface/span_newton.hpp"

namespace bladefit {
namespace {

/// A / w and its derivatives, by the quotient rule; the fourth numbers then mean nothing.
BLADEFIT_INLINE void project(Form& h) {
  const double inverse = 1.0 / h.a[3], w_u = h.a_u[3], w_v = h.a_v[3];
  h.a = h.a * inverse;
  h.a_u = (h.a_u - w_u * h.a) * inverse;
  h.a_v = (h.a_v - w_v * h.a) * inverse;
  h.a_uu = (h.a_uu - (2.0 * w_u) * h.a_u - h.a_uu[3] * h.a) * inverse;
  h.a_uv = (h.a_uv - w_u * h.a_v - w_v * h.a_u - h.a_uv[3] * h.a) * inverse;
  h.a_vv = (h.a_vv - (2.0 * w_v) * h.a_v - h.a_vv[3] * h.a) * inverse;
}

/// The sums of the first three of each.
BLADEFIT_INLINE Four sums(const Four& p, const Four& q, const Four& r, const Four& s) {
  Four rest;
  const Four3 t = transposed(p, q, r, s, rest);
  return t.x + t.y + t.z;
}

}  // namespace

SpanEnd newton_in_bicubic(const SpanTask& task, SpanFoot& foot) {
  const Four r{task.r[0], task.r[1], task.r[2], 1.0};
  return newton_steps(
      task, foot, [&](double x, double y) __attribute__((always_inline)) {
        SurfaceHere<Form> at{evaluate(task.taylor, x, y), 0, {}};
        Form& h = at.h;
        project(h);
        const Four offset = r - h.a, along_v = offset * h.a_v;
        const Four m = sums(h.a_u * h.a_u, h.a_u * h.a_v, h.a_v * h.a_v, offset * offset);
        const Four c = sums(offset * h.a_uu, offset * h.a_uv, offset * h.a_vv, offset * h.a_u);
        const Four hessian = m - c;
        at.square = m[3];
        at.quadratic = {-c[3], -(along_v[0] + along_v[1] + along_v[2]), hessian[0], hessian[1], hessian[2], m[0], m[1],
                        m[2]};
        return at;
      });
}

}  // namespace bladefit
