#pragma once
#include <string>
#include <vector>

#include "tools/report/colour_scale.hpp"
#include "tools/results/session_report.hpp"

namespace bladefit {

/// Where a patch, or a part of it, is drawn: a box of (u, v) as a rectangle [SVG units], v upwards.
struct MapPanel {
  std::string title;
  ParameterBox part;  ///< of positive width and height
  double left = 0, top = 0, width = 0, height = 0;

  [[nodiscard]] double x(double u) const { return left + (u - part.u_min) / (part.u_max - part.u_min) * width; }
  [[nodiscard]] double y(double v) const { return top + (part.v_max - v) / (part.v_max - part.v_min) * height; }
};

/// Whether the foot of the point lies in the box.
[[nodiscard]] bool lies_in(const ReportPoint& point, const ParameterBox& box);

/// Frame, grid, axes and the shaded leading-edge region.
[[nodiscard]] std::string panel_frame(const MapPanel& panel, const std::vector<ParameterBox>& boxes);

/// The points of the panel; those that are out lie on top.
[[nodiscard]] std::string panel_points(const MapPanel& panel, const SessionReport& report, const ColourScale& scale);

/// The mark of one point with its centre at (x, y), as map and legend show it.
[[nodiscard]] std::string point_mark(const ReportPoint& point, double x, double y, const ColourScale& scale);

}  // namespace bladefit
