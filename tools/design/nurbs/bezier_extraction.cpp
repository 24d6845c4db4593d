#include "tools/design/nurbs/bezier_extraction.hpp"

#include <algorithm>
#include <utility>

#include "core/geometry/surface/taylor.hpp"

namespace bladefit {
namespace {

using Extended = long double;

/// One nonempty knot span inside the used range: its parameter is in [begin, end], which lies in the knot interval
/// [knots[index], knots[index + 1]].
struct KnotSpan {
  std::size_t index;
  double begin, end;
};

std::vector<KnotSpan> nonempty_spans(const SurfaceDirection& direction) {
  std::vector<KnotSpan> spans;
  const auto first = static_cast<std::size_t>(direction.degree);
  const auto last = static_cast<std::size_t>(direction.control_points);
  for (std::size_t k = first; k < last; ++k) {
    const double begin = std::max(direction.knots[k], direction.start);
    const double end = std::min(direction.knots[k + 1], direction.end);
    if (begin < end) spans.push_back({k, begin, end});
  }
  return spans;
}

std::vector<double> normalised_breaks(const SurfaceDirection& direction, const std::vector<KnotSpan>& spans) {
  const Extended length = static_cast<Extended>(direction.end) - direction.start;
  std::vector<double> breaks{0.0};
  for (const KnotSpan& span : spans) {
    breaks.push_back(static_cast<double>((static_cast<Extended>(span.end) - direction.start) / length));
  }
  breaks.back() = 1.0;
  return breaks;
}

/// The blossom (polar form) of the spline on `span` with `ends` arguments at its end and the others at its begin, of a
/// spline whose degree + 1 control points there are numbers: the Bezier control point number `ends`. Every step is a
/// convex combination, hence stable. (Ramshaw, Blossoming, 1987.)
Extended blossom(const SurfaceDirection& direction, const KnotSpan& span, int ends, std::vector<Extended> points) {
  const auto degree = static_cast<std::size_t>(direction.degree);
  for (std::size_t r = 1; r <= degree; ++r) {
    const Extended argument = r <= static_cast<std::size_t>(ends) ? span.end : span.begin;
    for (std::size_t i = degree; i >= r; --i) {
      const std::size_t knot = span.index - degree + i;
      const Extended left = direction.knots[knot];
      const Extended right = direction.knots[knot + degree - r + 1];
      const Extended alpha = (argument - left) / (right - left);
      points[i] = (1 - alpha) * points[i - 1] + alpha * points[i];
    }
  }
  return points[degree];
}

/// The share of control point l in Bezier point k is that point of a spline whose control points are 0, but for a 1.
Extraction extraction_of(const SurfaceDirection& direction, const std::vector<KnotSpan>& spans) {
  Extraction out;
  const auto order = static_cast<std::size_t>(direction.degree) + 1;
  for (const KnotSpan& span : spans) {
    out.first.push_back(static_cast<std::uint32_t>(span.index + 1 - order));
    for (int k = 0; k <= direction.degree; ++k) {
      for (std::size_t l = 0; l < order; ++l) {
        std::vector<Extended> unit(order, 0);
        unit[l] = 1;
        out.shares.push_back(static_cast<double>(blossom(direction, span, k, std::move(unit))));
      }
    }
  }
  return out;
}

/// The control points in homogeneous form. Weights that are all equal stand for 1.
std::vector<double> homogeneous_points(const NurbsSurface& surface, bool rational) {
  std::vector<double> points;
  points.reserve(4 * surface.control_points.size());
  for (std::size_t k = 0; k < surface.control_points.size(); ++k) {
    const double weight = rational ? surface.weights[k] : 1.0;
    for (const double coordinate : surface.control_points[k]) points.push_back(weight * coordinate);
    points.push_back(weight);
  }
  return points;
}

}  // namespace

BezierNet net_of(const BezierSpan& span) {
  BezierNet net;
  net.degree_u = span.degree_u;
  net.degree_v = span.degree_v;
  for (std::uint32_t k = 0; k < (span.degree_u + 1) * (span.degree_v + 1); ++k)
    net.points[k] = Eigen::Map<const Homogeneous>(span.net + 4U * k);
  return net;
}

SpanSource BezierPatch::source(std::size_t index) const {
  const auto order_u = static_cast<std::size_t>(degree_u) + 1, order_v = static_cast<std::size_t>(degree_v) + 1;
  return {&points[4 * first_point(index)],
          static_cast<std::uint32_t>(points_v),
          &along_u.shares[index / spans_v() * order_u * order_u],
          &along_v.shares[index % spans_v() * order_v * order_v],
          static_cast<std::uint32_t>(degree_u),
          static_cast<std::uint32_t>(degree_v),
          rational};
}

BezierPatch extract_bezier(const NurbsSurface& surface) {
  const std::vector<KnotSpan> spans_u = nonempty_spans(surface.u);
  const std::vector<KnotSpan> spans_v = nonempty_spans(surface.v);
  BezierPatch patch;
  patch.degree_u = surface.u.degree;
  patch.degree_v = surface.v.degree;
  patch.breaks_u = normalised_breaks(surface.u, spans_u);
  patch.breaks_v = normalised_breaks(surface.v, spans_v);
  patch.rational = std::any_of(surface.weights.begin(), surface.weights.end(),
                               [&](double weight) { return weight != surface.weights.front(); });
  patch.points = homogeneous_points(surface, patch.rational);
  patch.points_v = static_cast<std::size_t>(surface.v.control_points);
  patch.along_u = extraction_of(surface.u, spans_u);
  patch.along_v = extraction_of(surface.v, spans_v);
  patch.coefficients.resize(spans_u.size() * spans_v.size() * patch.span_size());
  for (std::size_t k = 0; k < spans_u.size() * spans_v.size(); ++k)
    bezier_points(patch.source(k), &patch.coefficients[k * patch.span_size()]);
  patch.taylor = patch.coefficients;
  for (std::size_t k = 0; k < patch.taylor.size(); k += patch.span_size()) {
    to_taylor_form(static_cast<std::uint32_t>(patch.degree_u), static_cast<std::uint32_t>(patch.degree_v),
                   &patch.taylor[k]);
  }
  return patch;
}

}  // namespace bladefit
