#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/surface/span_net.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// One Bezier span: control net and Taylor form, as in the image. A view.
struct BezierSpan {
  const double* net;
  const double* taylor;
  std::uint32_t degree_u, degree_v;
};

[[nodiscard]] BezierNet net_of(const BezierSpan& span);

/// How the spans of one direction come from its control points: see ImagePatch.
struct Extraction {
  std::vector<std::uint32_t> first;  ///< of each span, the first of the degree + 1 control points that it is made of
  std::vector<double> shares;        ///< (degree + 1)^2 a span
};

/// A NURBS surface cut at its knots into spans_u x spans_v Bezier spans, parameters normalised to 0..1.
struct BezierPatch {
  int degree_u = 0, degree_v = 0;
  std::vector<double> breaks_u, breaks_v;  ///< rising, the first 0, the last 1
  bool rational = false;                   ///< false: every weight is 1
  std::vector<double> points;              ///< the control points of the surface, homogeneous, as given
  std::size_t points_v = 0;                ///< of a row
  Extraction along_u, along_v;
  /// Homogeneous (w x, w y, w z, w) [mm]. Span (iu, iv) is the (iu * spans_v + iv)-th block of
  /// (degree_u + 1) * (degree_v + 1) control points; control point (i, j) of it is number i * (degree_v + 1) + j.
  std::vector<double> coefficients;
  std::vector<double> taylor;  ///< the Taylor forms of the spans, in the same places

  [[nodiscard]] std::size_t spans_u() const { return breaks_u.size() - 1; }
  [[nodiscard]] std::size_t spans_v() const { return breaks_v.size() - 1; }
  /// Doubles of one span.
  [[nodiscard]] std::size_t span_size() const {
    return 4 * static_cast<std::size_t>(degree_u + 1) * static_cast<std::size_t>(degree_v + 1);
  }
  /// The number of the first control point that a span is made of.
  [[nodiscard]] std::size_t first_point(std::size_t index) const {
    return along_u.first[index / spans_v()] * points_v + along_v.first[index % spans_v()];
  }
  [[nodiscard]] SpanSource source(std::size_t index) const;
  [[nodiscard]] BezierSpan span(std::size_t index) const {
    const std::size_t first = index * span_size();
    return {&coefficients[first], &taylor[first], static_cast<std::uint32_t>(degree_u),
            static_cast<std::uint32_t>(degree_v)};
  }
};

/// Cuts `surface`, which check_surface has accepted, at its knots. Shares are worked out in extended precision, and
/// nets from them as the image's reader does, to the same bits. Cost: linear in the number of spans.
BezierPatch extract_bezier(const NurbsSurface& surface);

}  // namespace bladefit
