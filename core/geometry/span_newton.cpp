#include "core/geometry/span_newton.hpp"

#include "core/geometry/taylor.hpp"

namespace bladefit {
namespace {

[[gnu::always_inline]] inline double dot(const Homogeneous& a, const Homogeneous& b) {
  const Homogeneous c = a * b;
  return c[0] + c[1] + c[2];
}

[[gnu::always_inline]] inline void store(double (&to)[4], const Homogeneous& from) {
  Eigen::Map<Homogeneous> place(to);
  place = from;
}

struct SurfaceHere {
  HomogeneousDerivatives h;
  double square;
  DistanceQuadratic quadratic;

  [[gnu::always_inline]] inline void finish(double dx, double dy, SpanFoot& foot) const {
    store(foot.s, h.a + dx * h.a_u + dy * h.a_v);
    store(foot.s_u, h.a_u + dx * h.a_uu + dy * h.a_uv);
    store(foot.s_v, h.a_v + dx * h.a_uv + dy * h.a_vv);
    store(foot.s_uu, h.a_uu);
    store(foot.s_uv, h.a_uv);
    store(foot.s_vv, h.a_vv);
  }
};

}  // namespace

SpanEnd newton_in_span(const SpanTask& task, SpanFoot& foot) {
  const Homogeneous r(task.r[0], task.r[1], task.r[2], 1.0);
  return newton_steps(
      task, foot, [&](double x, double y) __attribute__((always_inline)) {
        SurfaceHere at;
        HomogeneousDerivatives& h = at.h;
        evaluate_taylor(task.taylor, task.degree_u, task.degree_v, x, y, h);
        project(h);
        const Homogeneous offset = r - h.a;
        at.square = dot(offset, offset);
        at.quadratic = quadratic_at(h.a_u, h.a_v, h.a_uu, h.a_uv, h.a_vv, offset, dot);
        return at;
      });
}

}  // namespace bladefit
