#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/inspection/shaft_axis.hpp"
#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// Keeps the faces of blade `number` of a propeller (1 is the first), with a line to the warnings that tells which
/// these are. Where no axis [mm] is given, x, y and z are tried. Throws ToolError where no blades repeat about it, and
/// where there are not so many.
void keep_blade(DesignFile& design, std::size_t number, const std::optional<ShaftAxis>& axis, const std::string& file);

/// A number of --blade. Throws ToolError where it is not whole.
[[nodiscard]] std::size_t blade_number(double given);

/// A line for each blade of a propeller: its number, angle and faces, and one for the hub and the other faces. None
/// where no blades repeat about an axis.
[[nodiscard]] std::vector<std::string> blade_lines(const DesignFile& design);

}  // namespace bladefit
