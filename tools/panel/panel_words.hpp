#pragma once
#include <string>

#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// Panel values in the operator's words. A value that the map does not define becomes "?".
[[nodiscard]] std::string session_word(SessionState state);
[[nodiscard]] std::string fit_word(std::uint16_t fit_status);
[[nodiscard]] std::string state_word(PointState state);
[[nodiscard]] std::string action_word(Action action);
[[nodiscard]] std::string region_word(Region region);

/// The alarms that are on, parted by commas; empty = none.
[[nodiscard]] std::string alarm_words(const PanelState& state);

/// "+0.310 mm"; "-" where there is none.
[[nodiscard]] std::string signed_mm(float value);

/// "0.100 mm", or "not judged" for infinity.
[[nodiscard]] std::string tolerance_mm(float value);

}  // namespace bladefit
