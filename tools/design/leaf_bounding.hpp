#pragma once
#include "core/geometry/bezier.hpp"
#include "core/geometry/design_image.hpp"
#include "tools/design/bezier_extraction.hpp"

namespace bladefit {

/// Bounds of a rectangle of a Bezier span. Never too narrow: the
/// rectangle is cut into pieces, on each of which the control points bound the homogeneous derivatives, and interval
/// arithmetic carries them through the quotient rule. Cost: four restricted nets and their differences.
ImageBounds leaf_bounds(const BezierSpan& span, const LocalRect& rect);

}  // namespace bladefit
