#pragma once
#include <string>
#include <vector>

#include "core/fit/pose.hpp"
#include "core/geometry/surface/surface.hpp"
#include "core/probe_point.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {

/// A design, and where the points are thought to lie on it.
struct PlacedDesign {
  Surface surface;
  Pose start;                  ///< machine -> design
  double probe_radius_mm = 0;  ///< points are centres of a ball of this radius
};

/// How points lie on a design.
struct DesignMatch {
  bool lies_on = false;  ///< when they are multiplied by `factor` they come to lie on it
  double factor = 1;     ///< of those that were tried
  double median_mm = 0;  ///< distance from the surface with this factor, else as they are
  bool averted = false;  ///< their directions run out of the material
};

/// Factors between what a device counts in and millimetres that are tried beside 1.
inline constexpr double kFactors[] = {0.001, 1 / kMmPerInch, kMmPerInch, 1000};

/// Fewer points than this say nothing.
inline constexpr std::size_t kLeastPoints = 3;

/// Tries the factors. Cost: some hundred searches at most.
[[nodiscard]] DesignMatch match_design(const PlacedDesign& design, const std::vector<ProbePoint>& points);

/// "x 1.0 to 2.0, y ... mm" of the points, and of the design in the machine's coordinates beside it.
[[nodiscard]] std::string box_text(const std::vector<ProbePoint>& points);
[[nodiscard]] std::string box_text(const PlacedDesign& design);

}  // namespace bladefit
