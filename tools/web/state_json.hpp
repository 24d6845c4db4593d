#pragma once
#include <string>

#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// What the panel shows, as one line of JSON: lengths in mm, angles in rad, null for what is not finite or not known.
/// Whoever presses commands may do so only where `commands` says that a token is set.
[[nodiscard]] std::string state_json(const PanelState& state, bool commands);

}  // namespace bladefit
