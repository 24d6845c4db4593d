#pragma once
#include "core/localizer.hpp"
#include "firmware_bridge/host/blade/blade_counts.hpp"

namespace bladefit {

/// Where the next probe tells most: while the points leave a direction of the pose open, where a point would say most
/// about that; then in the longest stretch of the leading edge that has none; then where a side of the blade has none.
/// Cost: linear in the places of the layout.
[[nodiscard]] NextPlace next_place(const BladeLayout& layout, const BladeCounts& counts, const FitReport& report);

/// Whether the design has places on a side in a tenth of r/R, the leading edge left out. Cost: as above.
[[nodiscard]] bool has_surface(const BladeLayout& layout, BladeSide side, std::size_t band);

}  // namespace bladefit
