#pragma once
#include <string>
#include <vector>

#include "tools/design/iges/iges_parameters.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

inline constexpr int kIgesSurfaceType = 128;
/// The library makes no surface of a higher degree.
inline constexpr int kHighestIgesDegree = 25;

/// Calls `visit(k)` for each control point number k of `surface` in the order of IGES, where the first index is the
/// fastest.
template <class Visit>
void iges_order(const NurbsSurface& surface, Visit visit) {
  const auto count_u = static_cast<std::size_t>(surface.u.control_points);
  const auto count_v = static_cast<std::size_t>(surface.v.control_points);
  for (std::size_t j = 0; j < count_v; ++j) {
    for (std::size_t i = 0; i < count_u; ++i) visit(i * count_v + j);
  }
}

/// Entity 128 (rational B-spline surface, IGES 5.3, section 4.24) as it stands, in the units of the file. Throws
/// ToolError for parameters that are missing, too few for the counts, or not numbers. The weights are those of the
/// file whatever its "polynomial" flag says. A parameter range that is missing, or from 0 to 0, becomes that of the
/// knots, and a line to `notes`. The surface is not otherwise checked.
NurbsSurface read_iges_surface(const IgesParameters& parameters, std::vector<std::string>& notes);

}  // namespace bladefit
