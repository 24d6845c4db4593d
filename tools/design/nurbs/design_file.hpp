#pragma once
#include <string>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// What a CAD file holds, checked and turned to mm.
struct DesignFile {
  std::vector<NurbsSurface> surfaces;  ///< at least one; patch k of the design is surfaces[k]
  DesignUnit unit = DesignUnit::mm;    ///< in which lengths of this design are shown
  std::vector<std::string> warnings;   ///< one line each: what was repaired or left out
  std::vector<std::string>
      trimmed;  ///< faces bounded inside their surface, which is used whole; as the file names them
};

}  // namespace bladefit
