#pragma once
#include <cstdint>
#include <limits>

#include "core/inspection/limits.hpp"
#include "core/inspection/region.hpp"

namespace bladefit {

/// A part of the blade with tolerances of its own: boxes of the patches, a band of radii about the shaft, or those
/// boxes within that band.
struct ToleranceZone {
  Region region = Region::rest;  ///< in which its points are summed up
  bool everywhere = false;       ///< the band alone; else the boxes of the tolerance map that have the zone's number
  double radius_low_mm = 0;      ///< of the band, both limits included
  double radius_high_mm = std::numeric_limits<double>::infinity();
  double plus_mm = std::numeric_limits<double>::infinity();  ///< of Limits
  double minus_mm = std::numeric_limits<double>::infinity();

  [[nodiscard]] constexpr Limits limits() const { return {plus_mm, minus_mm}; }
  /// Whether it ends at radii.
  [[nodiscard]] constexpr bool has_band() const {
    return radius_low_mm > 0.0 || radius_high_mm < std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] constexpr bool holds_radius(double radius_mm) const {
    return radius_mm >= radius_low_mm && radius_mm <= radius_high_mm;
  }
};

}  // namespace bladefit
