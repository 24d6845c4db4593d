#pragma once
#include <Eigen/Geometry>

#include "tools/design/iges_parameters.hpp"
#include "tools/design/nurbs_surface.hpp"

namespace bladefit {

inline constexpr int kIgesSurfaceType = 128;
inline constexpr int kIgesMatrixType = 124;

/// Entity 128 (rational B-spline surface, IGES 5.3, section 4.24) as it stands, in the units of the file. Throws
/// DesignError for parameters that are missing, too few for the counts, or not numbers. The weights are those of the
/// file whatever its "polynomial" flag says. The surface is not otherwise checked.
NurbsSurface read_iges_surface(const IgesParameters& parameters);

/// Entity 124 (transformation matrix, section 4.21) as it stands. Throws DesignError like read_iges_surface.
Eigen::Affine3d read_iges_matrix(const IgesParameters& parameters);

}  // namespace bladefit
