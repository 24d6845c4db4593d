#pragma once
#include <string>
#include <vector>

#include "tools/design/iges/iges_parameters.hpp"
#include "tools/design/nurbs/iges_writer.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// The library makes no surface of a higher degree.
inline constexpr int kHighestIgesDegree = 25;

/// Entity 128 (rational B-spline surface, IGES 5.3, section 4.24) as it stands, in the units of the file. Throws
/// ToolError for parameters that are missing, too few for the counts, or not numbers. The weights are those of the
/// file whatever its "polynomial" flag says. A parameter range that is missing, or from 0 to 0, becomes that of the
/// knots, and a line to `notes`. The surface is not otherwise checked.
NurbsSurface read_iges_surface(const IgesParameters& parameters, std::vector<std::string>& notes);

}  // namespace bladefit
