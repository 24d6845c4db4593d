#include "core/geometry/nearest/newton_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/simd/lanes.hpp"
#include "core/geometry/surface/span_newton.hpp"

namespace bladefit {
namespace {

/// Spans that pure Newton steps may lead through.
constexpr int kMaxSpans = 8;

[[gnu::always_inline]] inline Vec3 vector_of(const double (&numbers)[4]) {
  return {numbers[0], numbers[1], numbers[2]};
}

class NewtonWalk {
 public:
  /// `room`: for a Taylor form, where the image holds none.
  NewtonWalk(const Surface& surface, const Vec3& r, const ParameterLimits& limits, double* room)
      : surface_(surface), r_(r), limits_(limits), room_(room) {
    for (int k = 0; k < 3; ++k) task_.r[k] = r[k];
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
      const bool bicubic = task_.degree_u == 3 && task_.degree_v == 3;
      const SpanEnd end = bicubic && lanes_ ? newton_in_bicubic(task_, foot) : newton_in_span(task_, foot);
      if (foot.moved) start = clamped({place.span, u_of(foot.x), v_of(foot.y)}, limits_);
      if (end == SpanEnd::converged) {
        result.place = start;
        const SurfacePoint at{vector_of(foot.s),    vector_of(foot.s_u),  vector_of(foot.s_v),
                              vector_of(foot.s_uu), vector_of(foot.s_uv), vector_of(foot.s_vv)};
        result.at = scaled(at, per_u_, per_v_);
        result.offset = r_ - result.at.s;
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
    task_.taylor = surface_.taylor(place.span, room_);
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
  const Vec3& r_;
  const ParameterLimits& limits_;
  double* room_;
  bool lanes_ = lanes_available();
  SpanTask task_;
  SpanDomain domain_{};
  double per_u_ = 1, per_v_ = 1;
};

// Apart, so that the room is taken from the stack where it is needed only.
[[gnu::noinline]] bool walk_worked_out(const Surface& surface, const Vec3& r, const ParameterLimits& limits,
                                       SurfacePlace& start, Projection& result) {
  TaylorRoom room;
  return NewtonWalk(surface, r, limits, room.data()).run(start, result);
}

}  // namespace

bool newton_walk(const Surface& surface, const Vec3& r, const ParameterLimits& limits, SurfacePlace& start,
                 Projection& result) {
  if (!surface.holds_taylor()) return walk_worked_out(surface, r, limits, start, result);
  return NewtonWalk(surface, r, limits, nullptr).run(start, result);
}

SurfacePlace clamped(const SurfacePlace& place, const ParameterLimits& limits) {
  return {place.span, std::clamp(place.u, limits.u_min, limits.u_max), std::clamp(place.v, limits.v_min, limits.v_max)};
}

}  // namespace bladefit
