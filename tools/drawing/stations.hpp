#pragma once
#include <optional>
#include <vector>

#include "tools/drawing/radius_grid.hpp"

namespace bladefit {

/// The ends of the longest chord of a section: the leading edge is the one nearer to the leading-edge region, or either
/// where there is none. Nothing where the cylinder does not cut the design, or in one point.
[[nodiscard]] std::optional<BladeStation> station_of(const std::vector<SectionPiece>& pieces, double radius);

/// Stations evenly from the least radius of the design to its greatest.
[[nodiscard]] std::vector<BladeStation> stations_of(const RadiusGrid& grid);

/// The station at a radius, between those it lies between, or that at the end. At least one is there.
[[nodiscard]] BladeStation station_at(const std::vector<BladeStation>& stations, double radius);

}  // namespace bladefit
