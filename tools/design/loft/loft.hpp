#pragma once
#include <optional>
#include <vector>

#include "tools/design/loft/sections_csv.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// How sections become a surface.
struct LoftSettings {
  int degree = 3;                          ///< along the sections, v
  int span_degree = 3;                     ///< from section to section, u
  std::optional<int> control_points = {};  ///< along a section
  std::vector<double> knots = {};          ///< internal ones along a section, in place of uniform ones where not empty
  bool follow_points = false;              ///< knots are dense where the points of the sections are
  bool knots_at_sections = false;          ///< over the sections: knots are means of their u, in place of uniform ones
};

/// The control points along a section that are taken unless others are asked for: a third of the points of the shortest
/// section as knots, as in the thesis (60 knots for 180 points, section 5.4), hence degree + 1 fewer control points.
int default_control_points(const BladeSections& sections, int degree);

/// The surface through the sections (thesis, section 5.4; The NURBS Book, sections 9.4 and 10.3): to each section a
/// spline by least squares over its chord length, first and last point interpolated, the same knots for all; then
/// through their control points splines from section to section, section k of n at u = k / (n - 1), internal
/// knots uniform or, where wanted, by eq. 9.8: with many sections uniform ones do not determine the surface. u runs
/// over the sections in the order of the file, v along them, both 0..1. Lengths are turned to mm. Throws ToolError for
/// settings that cannot be, and for sections that are too few, have too few points or do not determine the curve. Cost:
/// points x degree^2.
NurbsSurface loft(const BladeSections& sections, const LoftSettings& settings, double mm_per_unit);

/// How far the points of the sections are from their nearest points on a surface.
struct LoftDeviation {
  std::size_t points = 0;
  double rms_mm = 0, largest_mm = 0;
  std::size_t section = 0, point = 0;  ///< where the largest is; `point` inside its section
};

/// Measures the lofted surface against its sections. Cost: one global projection a point.
LoftDeviation loft_deviation(const NurbsSurface& surface, const BladeSections& sections, double mm_per_unit);

}  // namespace bladefit
