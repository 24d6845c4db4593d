#pragma once
#include <Eigen/Core>

#include "tools/design/nurbs/bezier_extraction.hpp"

namespace bladefit {

/// A straight line in the parameters of a span, each 0..1.
struct SpanLine {
  double s_from, t_from, s_to, t_to;
};

/// The surface along a line, in a parameter that runs from 0 to 1: the lengths of its derivatives of first, second and
/// third order are nowhere greater [mm].
struct PieceBounds {
  Eigen::Vector3d start, end;
  double slope, bend, third;
};

/// By the control points of the curve, which is a Bezier curve of degree_u + degree_v; wider by what rounding may do.
[[nodiscard]] PieceBounds piece_bounds(const BezierSpan& span, const SpanLine& line);

}  // namespace bladefit
