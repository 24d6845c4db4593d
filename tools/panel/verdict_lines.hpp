#pragma once
#include <string>

#include "tools/panel/page.hpp"

namespace bladefit {

/// The verdict and the worst place, large where there is room, and what to do.
void put_verdict(const ScreenView& view, Page& page, int height);

/// "IN TOLERANCE", and short: "IN".
[[nodiscard]] std::string blade_words(const PanelState& state);
[[nodiscard]] std::string short_blade_words(const PanelState& state);

}  // namespace bladefit
