#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// One Bezier span: control net and Taylor form, as in the image. A view.
struct BezierSpan {
  const double* net;
  const double* taylor;
  std::uint32_t degree_u, degree_v;
};

/// A NURBS surface cut at its knots into spans_u x spans_v Bezier spans, parameters normalised to 0..1.
struct BezierPatch {
  int degree_u = 0, degree_v = 0;
  std::vector<double> breaks_u, breaks_v;  ///< rising, the first 0, the last 1
  bool rational = false;                   ///< false: every weight is 1
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
  [[nodiscard]] BezierSpan span(std::size_t index) const {
    const std::size_t first = index * span_size();
    return {&coefficients[first], &taylor[first], static_cast<std::uint32_t>(degree_u),
            static_cast<std::uint32_t>(degree_v)};
  }
};

/// Cuts `surface`, which check_surface has accepted, at its knots. Works in extended precision, so that coefficients
/// are exact to the last bit or so. Cost: linear in the number of spans.
BezierPatch extract_bezier(const NurbsSurface& surface);

}  // namespace bladefit
