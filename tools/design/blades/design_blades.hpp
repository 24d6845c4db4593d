#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "core/inspection/shaft_axis.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// One blade of a propeller.
struct DesignBlade {
  std::vector<std::size_t> faces;  ///< rising
  double angle = 0;                ///< of its centre of area about the axis, as across() counts [rad]
};

/// The blades of a propeller. Blade 1 is blades[0]: that nearest to the direction of across(); the others follow as the
/// right hand turns about the axis.
struct DesignBlades {
  ShaftAxis axis;                   ///< about which they repeat [mm]
  std::vector<DesignBlade> blades;  ///< two or more; none where none were found
  std::vector<std::size_t> hub;     ///< surfaces of revolution about the axis
  std::vector<std::size_t> others;  ///< of neither
};

/// Finds the blades: what is no surface of revolution about the axis hangs together in groups, and the largest groups
/// that a turn about the axis brings into each other (area, centre and second moments within a few per cent) are the
/// blades. Smaller groups that repeat as often, no nearer to the axis, are parts of the nearest blade: a suction and a
/// pressure side whose edges do not meet. Without an axis x, y and z are tried, through the origin and through the
/// centre of all. None is found where blades hang together without a hub of revolution, or where a part may belong to
/// two blades. Cost: a tenth of a second for some hundred faces.
[[nodiscard]] DesignBlades find_blades(const std::vector<NurbsSurface>& surfaces, const std::optional<ShaftAxis>& axis);

}  // namespace bladefit
