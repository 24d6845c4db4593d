#pragma once
#include <string>

#include "tools/panel/page.hpp"

namespace bladefit {

/// The leading edge from root to tip, a sign a place, and what the signs mean; where there is room also how many points
/// both sides have. Nothing where no leading edge is set.
void put_edge_strip(const ScreenView& view, Page& page);

/// Hundredths that a place has on a strip with room for so many signs: as many as the passes of the program are apart,
/// so that what lies between two passes does not look as if it was left out.
[[nodiscard]] std::size_t place_size(const BladeView& blade, std::size_t room);

/// One sign a place of so many hundredths: the worst of them.
[[nodiscard]] std::string edge_signs(const BladeView& blade, std::size_t hundredths);

}  // namespace bladefit
