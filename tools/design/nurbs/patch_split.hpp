#pragma once
#include <string>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// Rectangle of normalised parameters of a patch.
struct ParameterRectangle {
  double u_min = 0, u_max = 1, v_min = 0, v_max = 1;
};

/// Normalised parameters, inside 0..1 and rising, at which a patch is cut.
struct PatchCuts {
  std::vector<double> u, v;
};

/// The rectangles into which `cuts` divide a patch, those of the first interval in u first.
std::vector<ParameterRectangle> divided(const PatchCuts& cuts);

/// The part of `surface`, which check_surface has accepted, over `part` of its normalised parameters: the same points,
/// parameters 0..1, clamped knots. A limit within 1e-12 of a knot is that knot. Exact but for the last rounding: knots
/// are inserted in extended precision (Boehm, Inserting new knots into B-spline curves, 1980).
/// Cost: control points x degree^2.
NurbsSurface part_of(const NurbsSurface& surface, const ParameterRectangle& part);

}  // namespace bladefit
