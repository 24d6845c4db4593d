#pragma once
#include <string>
#include <vector>

#include "tools/report/colour_scale.hpp"
#include "tools/report/tolerance_scale.hpp"
#include "tools/results/result.hpp"

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
[[nodiscard]] bool lies_in(const ResultPoint& point, const ParameterBox& box);

/// Frame, grid, axes and the shaded leading-edge region.
[[nodiscard]] std::string panel_frame(const MapPanel& panel, const std::vector<ParameterBox>& boxes);

/// The points of the panel, of those that are drawn; those that are out lie on top.
[[nodiscard]] std::string panel_points(const MapPanel& panel, const Result& result, const ColourScale& scale,
                                       const DrawnPoints& drawn);

/// The mark of a point with its centre at (x, y), as map and legend show it; `distance` in the units of the scale.
[[nodiscard]] std::string point_mark(PointState state, double distance, double x, double y, const ColourScale& scale);

}  // namespace bladefit
