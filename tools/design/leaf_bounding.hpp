#pragma once
#include <span>

#include "core/geometry/bezier.hpp"
#include "core/geometry/design_image.hpp"

namespace bladefit {

/// Bounds of a rectangle of a Bezier span; `coefficients` are the span's, as in BezierPatch. Never too narrow: the
/// rectangle is cut into pieces, on each of which the control points bound the homogeneous derivatives, and interval
/// arithmetic carries them through the quotient rule. Cost: four restricted nets and their differences.
ImageBounds leaf_bounds(std::span<const double> coefficients, int degree_u, int degree_v, const LocalRect& rect);

}  // namespace bladefit
