#include "core/geometry/newton_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/distance_quadratic.hpp"

namespace bladefit {
namespace {

constexpr int kMaxSteps = 12;
/// Spans that pure Newton steps may lead through.
constexpr int kMaxSpans = 8;

/// A foot sought inside one span, in its parameters x = s - 1/2, y = t - 1/2.
struct SpanTask {
  const double* taylor = nullptr;
  std::uint32_t degree_u = 0, degree_v = 0;
  Vec3 r = Vec3::Zero();
  double x_min = -0.5, x_max = 0.5, y_min = -0.5, y_max = 0.5;
  double last_step = 0;  ///< a step [mm] that is not longer is the last: Newton's error is then far under rounding
  double slack = 0;      ///< a distance may rise by this much as rounding [mm]

  [[nodiscard]] bool holds(double x, double y) const { return x >= x_min && x <= x_max && y >= y_min && y <= y_max; }
};

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
  SurfacePoint at;                ///< converged: the surface at (x, y), derivatives in x and y
};

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

/// Rounding may let a squared distance rise by a little.
[[gnu::always_inline]] inline bool rises(double square, double before, double slack) {
  return square > before && square > before + slack * (std::sqrt(before) + slack);
}

/// Cost: some 80 ns a step for a bicubic span; two steps from a neighbouring foot, at most kMaxSteps.
SpanEnd newton_in_span(const SpanTask& task, SpanFoot& foot) {
  const Homogeneous r(task.r[0], task.r[1], task.r[2], 1.0);
  double x = foot.x, y = foot.y;
  for (int k = 0; k < kMaxSteps; ++k) {
    HomogeneousDerivatives h;
    evaluate_taylor(task.taylor, task.degree_u, task.degree_v, x, y, h);
    project(h);
    const Homogeneous offset = r - h.a;
    const double square = dot(offset, offset);
    if (rises(square, foot.distance_squared, task.slack)) return SpanEnd::stuck;
    foot.x = x;
    foot.y = y;
    foot.distance_squared = square;
    foot.moved = true;
    const DistanceQuadratic q = quadratic_at(h.a_u, h.a_v, h.a_uu, h.a_uv, h.a_vv, offset, dot);
    double dx = 0, dy = 0;
    if (!q.newton_step(dx, dy)) return SpanEnd::stuck;
    x += dx;
    y += dy;
    const bool inside = task.holds(x, y);
    if (dx * dx * q.m_uu + 2.0 * dx * dy * q.m_uv + dy * dy * q.m_vv <= task.last_step * task.last_step) {
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

class NewtonWalk {
 public:
  NewtonWalk(const Surface& surface, const Vec3& r, const ParameterLimits& limits)
      : surface_(surface), limits_(limits) {
    task_.r = r;
    task_.last_step = kLastStep * surface.half_diagonal();
    task_.slack = kDistanceRounding * surface.half_diagonal();
  }

  /// True where it ends at a local minimum inside the limits. False: `start` has become the best place so far.
  bool run(SurfacePlace& start, Projection& result) {
    SurfacePlace place = start;
    SpanFoot foot;
    foot.distance_squared = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kMaxSpans; ++k) {
      enter(place, foot);
      const SpanEnd end = newton_in_span(task_, foot);
      if (foot.moved) start = clamped({place.span, u_of(foot.x), v_of(foot.y)}, limits_);
      if (end == SpanEnd::converged) {
        result.place = start;
        result.at = scaled(foot.at, per_u_, per_v_);
        result.offset = task_.r - result.at.s;
        result.converged = true;
        return true;
      }
      const SurfacePlace next{place.span, u_of(foot.next_x), v_of(foot.next_y)};
      if (end == SpanEnd::stuck || !within(next)) return false;
      place = next;
      surface_.settle(place);
    }
    return false;
  }

 private:
  void enter(const SurfacePlace& place, SpanFoot& foot) {
    const ImagePatch& patch = surface_.patch_of(place.span);
    domain_ = surface_.domain(place.span);
    per_u_ = 1.0 / (domain_.u_max - domain_.u_min);
    per_v_ = 1.0 / (domain_.v_max - domain_.v_min);
    task_.taylor = surface_.taylor(place.span);
    task_.degree_u = patch.degree_u;
    task_.degree_v = patch.degree_v;
    task_.x_min = limits_.u_min > domain_.u_min ? x_of(limits_.u_min) : -0.5;
    task_.x_max = limits_.u_max < domain_.u_max ? x_of(limits_.u_max) : 0.5;
    task_.y_min = limits_.v_min > domain_.v_min ? y_of(limits_.v_min) : -0.5;
    task_.y_max = limits_.v_max < domain_.v_max ? y_of(limits_.v_max) : 0.5;
    foot.x = x_of(place.u);
    foot.y = y_of(place.v);
    foot.moved = false;
  }

  [[nodiscard]] bool within(const SurfacePlace& p) const {
    return p.u >= limits_.u_min && p.u <= limits_.u_max && p.v >= limits_.v_min && p.v <= limits_.v_max;
  }
  [[nodiscard]] double x_of(double u) const { return (u - domain_.u_min) * per_u_ - 0.5; }
  [[nodiscard]] double y_of(double v) const { return (v - domain_.v_min) * per_v_ - 0.5; }
  [[nodiscard]] double u_of(double x) const { return domain_.u_min + (x + 0.5) * (domain_.u_max - domain_.u_min); }
  [[nodiscard]] double v_of(double y) const { return domain_.v_min + (y + 0.5) * (domain_.v_max - domain_.v_min); }

  const Surface& surface_;
  const ParameterLimits& limits_;
  SpanTask task_;
  SpanDomain domain_{};
  double per_u_ = 1, per_v_ = 1;
};

}  // namespace

bool newton_walk(const Surface& surface, const Vec3& r, const ParameterLimits& limits, SurfacePlace& start,
                 Projection& result) {
  return NewtonWalk(surface, r, limits).run(start, result);
}

SurfacePlace clamped(const SurfacePlace& place, const ParameterLimits& limits) {
  return {place.span, std::clamp(place.u, limits.u_min, limits.u_max), std::clamp(place.v, limits.v_min, limits.v_max)};
}

}  // namespace bladefit
