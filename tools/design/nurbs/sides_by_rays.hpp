#pragma once
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// For each surface the side away from the material, +1 that of Su x Sv, -1 the other one, 0 where the shape does not
/// tell: from outside a line meets a body an even number of times, from inside an odd number. That does not depend on
/// the sides of the other surfaces. Cost: up to some seconds for hundreds of surfaces.
[[nodiscard]] std::vector<int> sides_by_rays(const std::vector<NurbsSurface>& surfaces);

}  // namespace bladefit
