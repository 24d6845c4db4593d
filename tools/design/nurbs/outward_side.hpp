#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/surface/surface.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// Which side of a design is away from the material, and why.
struct OutwardSide {
  int sign;            ///< +1: that of Su x Sv; -1: the other one
  std::string reason;  ///< one line
};

/// Finds the side away from the material of surfaces that close around it, with gaps such as an open trailing edge,
/// root and tip: the winding number of the set, seen from its own points, is then near +1/2 or -1/2, but near 0 on an
/// open sheet. `file` is named in messages. Throws ToolError where the shape does not tell, or patches contradict
/// each other.
OutwardSide find_outward_side(const std::vector<NurbsSurface>& surfaces, const std::string& file);

/// The same of a compiled design, more coarsely; nothing where the shape does not tell. Cost: some 10 ms.
[[nodiscard]] std::optional<OutwardSide> outward_side_of(const Surface& surface);

}  // namespace bladefit
