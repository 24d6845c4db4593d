#pragma once
#include <cstdint>

#include "tools/design/nurbs/bezier_extraction.hpp"

namespace bladefit {

/// The sides of span (iu, iv) beyond which the surface ends or has a crease, as bits of ImageSpan::ends. A crease is
/// where the normals on the two sides of a knot differ by more than 1e-6 rad. Cost: 36 pairs of evaluations.
std::uint32_t span_ends(const BezierPatch& patch, std::size_t iu, std::size_t iv);

}  // namespace bladefit
