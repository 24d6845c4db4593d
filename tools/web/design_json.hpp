#pragma once
#include <string>

#include "core/geometry/surface/surface.hpp"
#include "core/inspection/shaft_axis.hpp"
#include "core/inspection/tolerance_map.hpp"

namespace bladefit {

/// The design to draw, as JSON: faces, and zones of the leading edge, as grids with places relative to the middle in
/// single precision, normals as bytes, and which points lie inside of a trimmed face, in base 64; the shaft's axis, R
/// [mm], and edge_limits() by r/R where there are zones. Cost: some 20,000 to 100,000 evaluations.
[[nodiscard]] std::string design_json(const Surface& surface, const ToleranceMap& tolerance, const ShaftAxis& axis,
                                      double tip_radius_mm, const std::string& name);

}  // namespace bladefit
