#include "tools/design/image/reach_forms.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Spans in each direction that one form is made over.
constexpr std::uint32_t kMostSpans = 3;
/// Control points are exact to this share of the coordinates: what counts where a span is hair-thin.
constexpr double kPointRounding = 1e-14;

/// The least of x^2 - 2 radius slope x.
double least_of(const Interval& x, const Interval& slope, double radius) {
  const auto least = [radius](double low, double high, double steepest) {
    const double at = std::clamp(radius * steepest, low, high);
    return at * (at - 2.0 * radius * steepest);
  };
  double sum = kNothing.low;
  if (x.high >= 0.0) sum = std::min(sum, least(std::max(x.low, 0.0), x.high, slope.high));
  if (x.low < 0.0) sum = std::min(sum, least(x.low, std::min(x.high, 0.0), slope.low));
  return sum;
}

double square_of_least(const Interval& x) {
  const double off = std::max({x.low, -x.high, 0.0});
  return off * off;
}

/// A positive definite matrix, in the worst case of the ranges.
bool definite(const Interval& aa, const Interval& ab, const Interval& bb) {
  const double mixed = ab.magnitude();
  return aa.low > 0.0 && bb.low > 0.0 && aa.low * bb.low > mixed * mixed;
}

void include(IntervalVector& hull, const IntervalVector& other) {
  for (std::size_t k = 0; k < 3; ++k) hull[k].include(other[k]);
}

void widen(IntervalVector& range, double by) {
  for (Interval& axis : range) {
    axis.low -= by;
    axis.high += by;
  }
}

/// By what rounding of the control points may do to differences of them.
void widen(std::array<IntervalVector, 5>& derivative, double rounding, double per_u, double per_v) {
  const std::array<double, 5> by{per_u, per_v, per_u * per_u, per_u * per_v, per_v * per_v};
  for (std::size_t k = 0; k < by.size(); ++k) widen(derivative[k], rounding * by[k]);
}

bool goes_on_smoothly(const Surface& surface, const SmoothSides& smooth, const PatchRect& r) {
  const ImagePatch& p = surface.image().patches()[r.patch];
  for (std::uint32_t iu = r.iu_low; iu <= r.iu_high; ++iu) {
    for (std::uint32_t iv = r.iv_low; iv <= r.iv_high; ++iv) {
      const std::uint32_t span = p.first_span + iu * p.spans_v + iv;
      if (iu < r.iu_high && !smooth.beyond_high_u(span)) return false;
      if (iv < r.iv_high && !smooth.beyond_high_v(span)) return false;
    }
  }
  return true;
}

/// The derivatives u, v, uu, uv, vv over the rectangle.
std::array<IntervalVector, 5> derivatives_over(const Surface& surface, const PieceFrame& frame, const PatchRect& r) {
  const ImagePatch& p = surface.image().patches()[r.patch];
  const double rounding = kPointRounding * (surface.middle().norm() + surface.half_diagonal());
  std::array<IntervalVector, 5> hull;
  hull.fill({kNothing, kNothing, kNothing});
  for (std::uint32_t iu = r.iu_low; iu <= r.iu_high; ++iu) {
    for (std::uint32_t iv = r.iv_low; iv <= r.iv_high; ++iv) {
      const std::uint32_t span = p.first_span + iu * p.spans_v + iv;
      const SpanDomain d = surface.domain(span);
      const double wide = d.u_max - d.u_min, high = d.v_max - d.v_min;
      const auto local = [](double low, double width, double x) { return std::clamp((x - low) / width, 0.0, 1.0); };
      const LocalRect rect{local(d.u_min, wide, r.limits.u_min), local(d.u_min, wide, r.limits.u_max),
                           local(d.v_min, high, r.limits.v_min), local(d.v_min, high, r.limits.v_max)};
      if (!(rect.s_min < rect.s_max && rect.t_min < rect.t_max)) continue;
      const PieceScale scale{1.0 / (wide * (rect.s_max - rect.s_min)), 1.0 / (high * (rect.t_max - rect.t_min))};
      PieceRange range = FramedPiece(bezier_net_of(surface, span), rect, frame, scale).range();
      widen(range.derivative, rounding, 2.0 * p.degree_u * scale.along_u, 2.0 * p.degree_v * scale.along_v);
      for (std::size_t k = 0; k < hull.size(); ++k) include(hull[k], range.derivative[k]);
    }
  }
  return hull;
}

}  // namespace

bool FarBox::clear(const PartView& feet, SurfaceSide side, double radius) const {
  const double sign = sign_of(side);
  double least = least_of(arm[0], {sign, sign}, radius);
  for (const std::size_t k : {0U, 1U}) least += least_of(arm[k + 1], sign * feet.slope[k], radius);
  return least > 0.0;
}

double FarBox::distance() const {
  return std::sqrt(square_of_least(arm[0]) + square_of_least(arm[1]) + square_of_least(arm[2]));
}

bool NearForm::clear(SurfaceSide side, double radius) const {
  const double by = -sign_of(side) * radius;
  return definite(m_aa, m_ab, m_bb) && definite(m_aa + by * k_aa, m_ab + by * k_ab, m_bb + by * k_bb);
}

std::optional<NearForm> near_form(const Surface& surface, const SmoothSides& smooth, const PartView& feet,
                                  const PatchRect& rect) {
  if (rect.iu_high - rect.iu_low >= kMostSpans || rect.iv_high - rect.iv_low >= kMostSpans) return std::nullopt;
  if (!goes_on_smoothly(surface, smooth, rect)) return std::nullopt;
  const std::array<IntervalVector, 5> d = derivatives_over(surface, feet.frame, rect);
  const double alpha = feet.stretch[0], beta = feet.stretch[1], gamma = feet.stretch[2];
  const IntervalVector a = alpha * d[0], b = beta * d[1] + gamma * d[0];
  const IntervalVector aa = (alpha * alpha) * d[2], ab = (alpha * beta) * d[3] + (alpha * gamma) * d[2],
                       bb = (beta * beta) * d[4] + (2.0 * beta * gamma) * d[3] + (gamma * gamma) * d[2];
  const IntervalVector normal{Interval{1.0, 1.0}, feet.slope[0], feet.slope[1]};
  return NearForm{rect, dot(a, a), dot(a, b), dot(b, b), dot(aa, normal), dot(ab, normal), dot(bb, normal)};
}

}  // namespace bladefit
