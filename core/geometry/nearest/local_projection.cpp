#include "core/geometry/nearest/local_projection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/geometry/nearest/collapsed_side.hpp"
#include "core/geometry/nearest/held_sides.hpp"
#include "core/geometry/nearest/newton_walk.hpp"
#include "core/geometry/surface/distance_quadratic.hpp"
#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

constexpr int kMaxEvaluations = 60;
/// A tangential offset below this [half diagonals] counts as perpendicular.
constexpr double kPerpendicular = 1e-11;
/// A last step that moves a parameter by more than this [spans], as it does about a pole, is evaluated.
constexpr double kWideStep = 1e-3;
/// What is nearer to a pole than this cannot be told from it [half diagonals].
constexpr double kAboutPole = 1e-8;
/// Where the distance is greatest at a pole, the first step away from it [spans].
constexpr double kPoleStep = 1.0 / 16.0;

struct Step {
  double du = 0, dv = 0;
  bool newton = false;  ///< a full second-order step: convergence is quadratic
};

DistanceQuadratic quadratic_of(const SurfacePoint& p, const Vec3& offset) {
  return quadratic_at(p.s_u, p.s_v, p.s_uu, p.s_uv, p.s_vv, offset,
                      [](const Vec3& a, const Vec3& b) { return a.dot(b); });
}

double step_1d(double g, double h, double m, bool& newton) {
  newton = h > 1e-6 * m;
  if (newton) return -g / h;
  return m > 0.0 ? -g / m : 0.0;
}

/// Newton where the Hessian is positive definite, Gauss-Newton where it is not, one variable alone where the other is
/// held.
Step step_of(const DistanceQuadratic& q, bool hold_u, bool hold_v) {
  Step step;
  if (hold_u && hold_v) return {0, 0, true};
  if (hold_u) {
    step.dv = step_1d(q.g_v, q.h_vv, q.m_vv, step.newton);
    return step;
  }
  if (hold_v) {
    step.du = step_1d(q.g_u, q.h_uu, q.m_uu, step.newton);
    return step;
  }
  step.newton = q.newton_step(step.du, step.dv);
  if (step.newton) return step;
  const double det = q.m_uu * q.m_vv - q.m_uv * q.m_uv;
  if (det > 1e-12 * q.m_uu * q.m_vv) {
    step.du = -(q.m_vv * q.g_u - q.m_uv * q.g_v) / det;
    step.dv = -(q.m_uu * q.g_v - q.m_uv * q.g_u) / det;
    return step;
  }
  const double m = q.m_uu + q.m_vv;  // degenerate parametrisation: follow the gradient
  if (m > 0.0) step = {-q.g_u / m, -q.g_v / m, false};
  return step;
}

class Descent {
 public:
  Descent(const Surface& surface, const Vec3& r, const SurfacePlace& start, const ParameterLimits& limits)
      : surface_(surface), r_(r), limits_(limits), scale_(surface.half_diagonal()) {
    result_.place = start;
    result_.at = surface_.evaluate(result_.place);
    result_.offset = r_ - result_.at.s;
  }

  Projection run() {
    bool crossed = false;
    for (int evaluations = 1; evaluations < kMaxEvaluations;) {
      const DistanceQuadratic q = quadratic_of(result_.at, result_.offset);
      hold_at_limits(q);
      if (const std::size_t side = pole_here(); side != kNoSide) {
        if (leave_pole(side, evaluations)) continue;
        rest_on_pole(side);
        break;
      }
      Step step = step_of(q, result_.fixed_u, result_.fixed_v);
      step = blocked(q, step);
      const double length = (result_.at.s_u * step.du + result_.at.s_v * step.dv).norm();
      if (length <= kLastStep * scale_) {
        const std::uint32_t span = result_.place.span;
        finish(step);
        result_.at_pole = !step.newton && about_pole();
        result_.converged = step.newton || result_.at_pole;
        if (result_.place.span == span || crossed) break;
        // It has left its span, which may be thinner than that step: what is beyond may fall on.
        crossed = true;
        result_.converged = result_.at_pole = false;
        result_.at = surface_.evaluate(result_.place);
        result_.offset = r_ - result_.at.s;
        ++evaluations;
        continue;
      }
      if (!descend(step, evaluations)) break;
    }
    return result_;
  }

 private:
  /// Away from an edge by this much [mm] counts as a falling distance beyond it.
  [[nodiscard]] bool falls(double gradient, const Vec3& tangent) const {
    return std::abs(gradient) > kPerpendicular * scale_ * tangent.norm();
  }

  void hold_at_limits(const DistanceQuadratic& q) {
    const SurfacePlace& p = result_.place;
    const bool out_u = (p.u <= limits_.u_min && q.g_u > 0.0) || (p.u >= limits_.u_max && q.g_u < 0.0);
    const bool out_v = (p.v <= limits_.v_min && q.g_v > 0.0) || (p.v >= limits_.v_max && q.g_v < 0.0);
    result_.fixed_u = out_u && falls(q.g_u, result_.at.s_u);
    result_.fixed_v = out_v && falls(q.g_v, result_.at.s_v);
  }

  /// A coupled step may lead out of the limits although the gradient does not: then that variable rests in this step.
  [[nodiscard]] Step blocked(const DistanceQuadratic& q, const Step& step) const {
    const SurfacePlace& p = result_.place;
    const bool u = (p.u <= limits_.u_min && step.du < 0.0) || (p.u >= limits_.u_max && step.du > 0.0);
    const bool v = (p.v <= limits_.v_min && step.dv < 0.0) || (p.v >= limits_.v_max && step.dv > 0.0);
    if (!u && !v) return step;
    return step_of(q, u || result_.fixed_u, v || result_.fixed_v);
  }

  [[nodiscard]] std::size_t pole_here() const { return pole_side(surface_, result_.place, result_.at, kPole * scale_); }

  /// Takes a step on the way on which the distance falls most; false where it falls on none: the pole is the minimum,
  /// with the parameter of the way on which it rises least.
  bool leave_pole(std::size_t side, int& evaluations) {
    const PoleWay way =
        steepest_from_pole(surface_, result_.place, side, result_.offset, limits_, kPerpendicular * scale_);
    result_.place = way.place;
    result_.at = surface_.evaluate(way.place);
    result_.offset = r_ - result_.at.s;
    if (!way.falls) return false;
    const SpanDomain d = surface_.domain(way.place.span);
    const bool along_v = is_along_v(side);
    const double inward = is_high(side) ? -1.0 : 1.0;
    const double width = inward * (along_v ? d.u_max - d.u_min : d.v_max - d.v_min);
    const Vec3& tangent = along_v ? result_.at.s_u : result_.at.s_v;
    const double least = std::max(0.0, inward * result_.offset.dot(tangent) / tangent.squaredNorm());
    const double length = way.slope < -kPerpendicular * scale_ ? inward * least : kPoleStep * width;
    return descend(along_v ? Step{length, 0.0} : Step{0.0, length}, evaluations);
  }

  /// So near to a pole that a minimum there cannot be told from the pole: Newton's method has no room to turn.
  [[nodiscard]] bool about_pole() const {
    const SpanPoles poles = poles_of(surface_, result_.place.span, kPole * scale_);
    if (!poles.any()) return false;
    SurfacePlace pole = result_.place;
    if (poles.u != PoleEnd::none) pole.u = poles.u == PoleEnd::low ? 0.0 : 1.0;
    if (poles.u == PoleEnd::none) pole.v = poles.v == PoleEnd::low ? 0.0 : 1.0;
    return (surface_.evaluate(pole).s - result_.at.s).norm() <= kAboutPole * scale_;
  }

  void rest_on_pole(std::size_t side) {
    hold_at_limits(quadratic_of(result_.at, result_.offset));
    (is_along_v(side) ? result_.fixed_v : result_.fixed_u) = false;
    result_.converged = result_.at_pole = true;
  }

  void move_to(SurfacePlace& place, double u, double v) const {
    place.u = std::clamp(u, limits_.u_min, limits_.u_max);
    place.v = std::clamp(v, limits_.v_min, limits_.v_max);
    surface_.settle(place);
  }

  bool descend(const Step& step, int& evaluations) {
    const double before = result_.distance_squared();
    const double rounding = kDistanceRounding * scale_;
    const double slack = rounding * (std::sqrt(before) + rounding);
    double fraction = 1.0;
    for (int halvings = 0; halvings < 30 && evaluations < kMaxEvaluations; ++halvings, fraction *= 0.5) {
      SurfacePlace place = result_.place;
      move_to(place, place.u + fraction * step.du, place.v + fraction * step.dv);
      const SurfacePoint at = surface_.evaluate(place);
      ++evaluations;
      const Vec3 offset = r_ - at.s;
      if (offset.squaredNorm() > before + slack) continue;
      result_.place = place;
      result_.at = at;
      result_.offset = offset;
      return true;
    }
    return false;
  }

  void finish(const Step& step) {
    const double u = result_.place.u, v = result_.place.v;
    move_to(result_.place, u + step.du, v + step.dv);
    const double du = result_.place.u - u, dv = result_.place.v - v;
    const SpanDomain d = surface_.domain(result_.place.span);
    if (std::abs(du) > kWideStep * (d.u_max - d.u_min) || std::abs(dv) > kWideStep * (d.v_max - d.v_min)) {
      result_.at = surface_.evaluate(result_.place);
      result_.offset = r_ - result_.at.s;
      return;
    }
    SurfacePoint& p = result_.at;
    p.s += du * p.s_u + dv * p.s_v;
    p.s_u += du * p.s_uu + dv * p.s_uv;
    p.s_v += du * p.s_uv + dv * p.s_vv;
    result_.offset = r_ - p.s;
  }

  const Surface& surface_;
  const Vec3& r_;
  const ParameterLimits& limits_;
  double scale_;
  Projection result_;
};

/// Outside of the trim loops, or held at a side of a patch that has some: what ends there is for the loops to say.
bool beyond_face(const Surface& surface, const Projection& p) {
  if (surface.patch_of(p.place.span).slab_count == 0) return false;
  const auto at_side = [](bool fixed, double t) { return fixed && (t <= 0.0 || t >= 1.0); };
  return at_side(p.fixed_u, p.place.u) || at_side(p.fixed_v, p.place.v) || !inside_face(surface.image(), p.place);
}

}  // namespace

Projection project_local(const Surface& surface, const Vec3& r, const SurfacePlace& start,
                         const ParameterLimits& limits) {
  Projection result;
  SurfacePlace place = clamped(start, limits);
  surface.settle(place);
  if (!newton_walk(surface, r, limits, place, result)) result = Descent(surface, r, place, limits).run();
  if (surface.has_trims()) result.outside = beyond_face(surface, result);
  return result;
}

Foot foot_of(const Surface& surface, const Projection& projection, double probe_radius) {
  Foot foot;
  foot.patch = surface.span(projection.place.span).patch;
  foot.u = projection.place.u;
  foot.v = projection.place.v;
  foot.point = projection.at.s;
  const HeldSides held = held_sides(surface, projection);
  foot.border = held.border;
  if (held.count == 0) {
    foot.normal = surface.normal(projection.place, projection.at);
    foot.distance = foot.normal.dot(projection.offset) - probe_radius;
    return foot;
  }
  const double length = projection.offset.norm();
  foot.kind = held.count == 1 ? FootKind::edge : FootKind::corner;
  foot.normal = held.side * projection.offset / length;
  foot.distance = held.side * length - probe_radius;
  foot.beyond = std::max(0.0, held.outward * foot.distance);
  return foot;
}

}  // namespace bladefit
