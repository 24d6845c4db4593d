#include "tools/design/nurbs/bezier_extraction.hpp"

#include <algorithm>

#include "core/geometry/surface/taylor.hpp"

namespace bladefit {
namespace {

using Extended = long double;
using ExtendedPoint = Eigen::Matrix<Extended, 4, 1>;

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

/// The blossom (polar form) of the spline on `span` with `ends` arguments at its end and the others at its begin: the
/// Bezier control point number `ends`. Every step is a convex combination, hence stable. (Ramshaw, Blossoming, 1987.)
ExtendedPoint blossom(const SurfaceDirection& direction, const KnotSpan& span, int ends,
                      std::vector<ExtendedPoint> points) {
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

/// The degree + 1 Bezier control points on `span` of the spline curve with the given control points.
std::vector<ExtendedPoint> bezier_points(const SurfaceDirection& direction, const KnotSpan& span,
                                         const std::vector<ExtendedPoint>& curve) {
  const auto first = curve.begin() + static_cast<std::ptrdiff_t>(span.index) - direction.degree;
  const std::vector<ExtendedPoint> local(first, first + direction.degree + 1);
  std::vector<ExtendedPoint> result;
  for (int ends = 0; ends <= direction.degree; ++ends) result.push_back(blossom(direction, span, ends, local));
  return result;
}

/// The net in homogeneous form, one curve along u for each j. Weights that are all equal stand for 1.
std::vector<std::vector<ExtendedPoint>> columns_of(const NurbsSurface& surface, bool rational) {
  const auto count_v = static_cast<std::size_t>(surface.v.control_points);
  std::vector<std::vector<ExtendedPoint>> columns(count_v);
  for (std::size_t k = 0; k < surface.control_points.size(); ++k) {
    const Extended weight = rational ? surface.weights[k] : 1.0;
    ExtendedPoint point;
    point << surface.control_points[k].cast<Extended>() * weight, weight;
    columns[k % count_v].push_back(point);
  }
  return columns;
}

/// Appends the spans of one strip (one span in u); `strip` holds its control points, strip[i] a spline curve along v.
void append_strip(const NurbsSurface& surface, const std::vector<KnotSpan>& spans_v,
                  const std::vector<std::vector<ExtendedPoint>>& strip, BezierPatch& patch) {
  for (const KnotSpan& span : spans_v) {
    for (const std::vector<ExtendedPoint>& curve : strip) {
      for (const ExtendedPoint& point : bezier_points(surface.v, span, curve)) {
        for (Eigen::Index axis = 0; axis < 4; ++axis) patch.coefficients.push_back(static_cast<double>(point[axis]));
      }
    }
  }
}

}  // namespace

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
  patch.coefficients.reserve(spans_u.size() * spans_v.size() * patch.span_size());
  const std::vector<std::vector<ExtendedPoint>> columns = columns_of(surface, patch.rational);
  for (const KnotSpan& span : spans_u) {
    std::vector<std::vector<ExtendedPoint>> strip(static_cast<std::size_t>(surface.u.degree) + 1);
    for (const std::vector<ExtendedPoint>& column : columns) {
      const std::vector<ExtendedPoint> points = bezier_points(surface.u, span, column);
      for (std::size_t i = 0; i < points.size(); ++i) strip[i].push_back(points[i]);
    }
    append_strip(surface, spans_v, strip, patch);
  }
  patch.taylor.resize(patch.coefficients.size());
  for (std::size_t k = 0; k < patch.coefficients.size(); k += patch.span_size()) {
    taylor_form(&patch.coefficients[k], static_cast<std::uint32_t>(patch.degree_u),
                static_cast<std::uint32_t>(patch.degree_v), &patch.taylor[k]);
  }
  return patch;
}

}  // namespace bladefit
