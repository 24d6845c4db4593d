#pragma once
#include <string>
#include <vector>

#include "tools/report/colour_scale.hpp"
#include "tools/report/session_report.hpp"

namespace bladefit {

/// Where one patch is drawn: the unit square of (u, v) as a rectangle [SVG units], v upwards.
struct MapPanel {
  std::uint32_t patch = 0;
  double left = 0, top = 0, width = 0, height = 0;

  [[nodiscard]] double x(double u) const { return left + u * width; }
  [[nodiscard]] double y(double v) const { return top + (1.0 - v) * height; }
};

/// Frame, grid, axes and the shaded leading-edge region.
[[nodiscard]] std::string panel_frame(const MapPanel& panel, const std::vector<ParameterBox>& boxes);

/// The points of the patch; those that are out lie on top.
[[nodiscard]] std::string panel_points(const MapPanel& panel, const SessionReport& report, const ColourScale& scale);

/// The mark of one point with its centre at (x, y), as map and legend show it.
[[nodiscard]] std::string point_mark(const ReportPoint& point, double x, double y, const ColourScale& scale);

}  // namespace bladefit
