#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/design/loft/foil.hpp"
#include "tools/design/loft/sections_csv.hpp"

namespace bladefit {

/// One row of a propeller table: a section at a radius. D is the diameter, c the chord.
struct BladeRow {
  double radius = 0;     ///< r/R
  double chord = 0;      ///< c/D
  double pitch = 0;      ///< P/D
  double skew = 0;       ///< of the middle of the chord, towards the trailing edge [degrees]
  double rake = 0;       ///< of the generator line, aft, without what skew adds to it; share of D
  double camber = 0;     ///< greatest, share of c
  double thickness = 0;  ///< greatest, share of c
};

/// The table of a blade.
struct BladeTable {
  std::string file;
  std::vector<BladeRow> rows;  ///< at least 4, radii rising
  std::string note;            ///< columns that are not used; empty = none
};

/// Reads a table from `text`, the content of the file `name`: the first line names the columns r_over_R, c_over_D,
/// P_over_D, f_over_c, t_over_c (or t_over_D) and, if there, skew (degrees) and rake_over_D, in any order. Throws
/// ToolError naming line, column and fix. Cost: linear in the size.
[[nodiscard]] BladeTable parse_blade_table(std::string_view text, const std::string& name);

/// How a table becomes a blade.
struct BladeShape {
  double diameter = 0;  ///< D, in the unit of the design
  Foil foil = Foil::naca66;
  bool left_handed = false;
  std::size_t sections = 65, points = 241;  ///< of them, and of each, an odd number
};

/// The sections of the blade, root to tip: x along the axis of the shaft, forward; the generator line along z; y so
/// that x, y, z are right-handed. Each section lies on a cylinder about x and runs from the trailing edge over the
/// pressure side to the leading edge and over the suction side back, dense at both. The thickness is laid off at right
/// angles to the nose-tail line. A section of a right-handed propeller leads towards -y. Chords come from a monotone
/// spline over sqrt(1 - r/R) where the table reaches the tip, all else from splines over r/R. Cost: linear in the
/// points.
[[nodiscard]] BladeSections sections_of(const BladeTable& table, const BladeShape& shape);

}  // namespace bladefit
