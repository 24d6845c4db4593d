#pragma once
#include <cstdint>

#include "core/geometry/surface/distance_quadratic.hpp"

namespace bladefit {

// Plain numbers and nothing that is not in line: the kernels of core/lanes include this.

/// A foot sought inside one span, in its parameters x = s - 1/2, y = t - 1/2.
struct SpanTask {
  const double* taylor = nullptr;
  std::uint32_t degree_u = 0, degree_v = 0;
  double r[3] = {0, 0, 0};  ///< the point [mm]
  double x_min = -0.5, x_max = 0.5, y_min = -0.5, y_max = 0.5;
  double last_step = 0;  ///< a step [mm] that is not longer is the last: Newton's error is then far under rounding
  double slack = 0;      ///< a distance may rise by this much as rounding [mm]
};

inline constexpr int kMaxNewtonSteps = 12;

enum class SpanEnd : std::uint8_t {
  converged,  ///< at a local minimum
  left,       ///< the next step leaves the limits
  stuck       ///< the squared distance is not convex here, did not fall, or steps were used up
};

struct SpanFoot {
  double x = 0, y = 0;            ///< where the distance was last seen to fall
  double next_x = 0, next_y = 0;  ///< where the step went that left the limits
  double distance_squared = 0;    ///< at (x, y) [mm^2]; given: not to be exceeded
  bool moved = false;             ///< (x, y) was evaluated: false where even the start was too far off
  /// Converged: the surface at (x, y) and its derivatives in x and y, each with a fourth number of no meaning.
  alignas(32) double s[4], s_u[4], s_v[4], s_uu[4], s_uv[4], s_vv[4];
};

/// The surface at a place: a point and its derivatives a, a_u ... a_vv, `Derivatives` of any vector of four numbers.
template <class Derivatives>
struct SurfaceHere {
  Derivatives h;
  double square;                ///< squared distance of the point sought for [mm^2]
  DistanceQuadratic quadratic;  ///< of half of that

  /// Writes the surface a last step away, by the derivatives at hand.
  [[gnu::always_inline]] inline void finish(double dx, double dy, SpanFoot& foot) const {
    put(foot.s, h.a + dx * h.a_u + dy * h.a_v);
    put(foot.s_u, h.a_u + dx * h.a_uu + dy * h.a_uv);
    put(foot.s_v, h.a_v + dx * h.a_uv + dy * h.a_vv);
    put(foot.s_uu, h.a_uu);
    put(foot.s_uv, h.a_uv);
    put(foot.s_vv, h.a_vv);
  }

 private:
  using Vector = decltype(Derivatives::a);
  [[gnu::always_inline]] static inline void put(double (&to)[4], const Vector& from) {
    static_assert(sizeof(from) == sizeof(to));
    __builtin_memcpy(to, &from, sizeof(to));
  }
};

/// Newton steps from (foot.x, foot.y). `evaluate(x, y)` gives the SurfaceHere. Cost: two evaluations from a
/// neighbouring foot, at most twelve.
template <class Evaluate>
[[gnu::always_inline]] inline SpanEnd newton_steps(const SpanTask& task, SpanFoot& foot, const Evaluate& evaluate) {
  double x = foot.x, y = foot.y;
  for (int k = 0; k < kMaxNewtonSteps; ++k) {
    const auto at = evaluate(x, y);
    const double before = foot.distance_squared;
    // Rounding may let a squared distance rise by a little.
    if (at.square > before && at.square > before + task.slack * (__builtin_sqrt(before) + task.slack)) {
      return SpanEnd::stuck;
    }
    foot.x = x;
    foot.y = y;
    foot.distance_squared = at.square;
    foot.moved = true;
    const DistanceQuadratic& q = at.quadratic;
    double dx = 0, dy = 0;
    if (!q.newton_step(dx, dy)) return SpanEnd::stuck;
    x += dx;
    y += dy;
    const bool inside = x >= task.x_min && x <= task.x_max && y >= task.y_min && y <= task.y_max;
    if (dx * dx * q.m_uu + 2.0 * dx * dy * q.m_uv + dy * dy * q.m_vv <= task.last_step * task.last_step) {
      if (!inside) return SpanEnd::stuck;
      at.finish(dx, dy, foot);
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

/// Any degrees, on any processor. Cost: some 60 ns a step for a bicubic span.
[[nodiscard]] SpanEnd newton_in_span(const SpanTask& task, SpanFoot& foot);

/// The same to the last bit for a bicubic span, where lanes_available(). Cost: some 40 ns a step.
[[nodiscard]] SpanEnd newton_in_bicubic(const SpanTask& task, SpanFoot& foot);

}  // namespace bladefit
