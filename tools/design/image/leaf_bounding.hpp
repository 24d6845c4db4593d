#pragma once
#include "core/geometry/surface/bezier.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"

namespace bladefit {

/// A leaf is hair-thin where it is so many times longer than wide, as between knots that all but coincide.
inline constexpr double kHairThin = 1000.0;

/// Bounds of a rectangle of a Bezier span. Never too narrow: the
/// rectangle is cut into pieces, on each of which the control points bound the homogeneous derivatives, and interval
/// arithmetic carries them through the quotient rule. Cost: four restricted nets and their differences.
ImageBounds leaf_bounds(const BezierSpan& span, const LocalRect& rect);

}  // namespace bladefit
