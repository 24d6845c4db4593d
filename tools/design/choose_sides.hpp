#pragma once
#include <string>

#include "config/outward_option.hpp"
#include "tools/design/nurbs/design_file.hpp"
#include "tools/design/nurbs/outward_side.hpp"

namespace bladefit {

/// Decides which side of each surface is away from the material, and sets `reversed` of the surfaces so that one sign
/// is right for all.
/// auto: that on which the shape closes around the material, whatever the sides of loose faces; where the shape does
/// not tell, that of closed shells. + and -: the side to which the faces look, or the opposite; the shape must not
/// tell that some look the other way. A list names faces by number, name or pattern; of the others the shape must tell.
/// Throws ToolError where nothing tells, and where file and shape contradict each other.
OutwardSide choose_sides(DesignFile& design, const OutwardChoice& asked, const std::string& file);

}  // namespace bladefit
