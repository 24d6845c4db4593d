#include "core/geometry/surface/span_newton.hpp"

#include "core/geometry/surface/taylor.hpp"

namespace bladefit {
namespace {

[[gnu::always_inline]] inline double homogeneous_dot(const Homogeneous& a, const Homogeneous& b) {
  const Homogeneous c = a * b;
  return c[0] + c[1] + c[2];
}

}  // namespace

SpanEnd newton_in_span(const SpanTask& task, SpanFoot& foot) {
  const Homogeneous r(task.r[0], task.r[1], task.r[2], 1.0);
  return newton_steps(
      task, foot, [&](double x, double y) __attribute__((always_inline)) {
        SurfaceHere<HomogeneousDerivatives> at;
        HomogeneousDerivatives& h = at.h;
        evaluate_taylor(task.taylor, task.degree_u, task.degree_v, x, y, h);
        project(h);
        const Homogeneous offset = r - h.a;
        at.square = homogeneous_dot(offset, offset);
        at.quadratic = quadratic_at(h.a_u, h.a_v, h.a_uu, h.a_uv, h.a_vv, offset, homogeneous_dot);
        return at;
      });
}

}  // namespace bladefit
