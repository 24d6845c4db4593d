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

/// "not probed", "in", "cut" ...
[[nodiscard]] std::string cell_word(EdgeCell cell);

/// "suction", "pressure", "nose"; empty where it is not known.
[[nodiscard]] std::string side_word(BladeSide side);

/// The alarms that are on, parted by commas; empty = none.
[[nodiscard]] std::string alarm_words(const PanelState& state);

/// "+0.310 mm"; "-" where there is none.
[[nodiscard]] std::string signed_mm(float value);

/// A machine coordinate: "+39.2"; "-" where there is none.
[[nodiscard]] std::string machine_mm(float value);

/// A part of R: "0.768".
[[nodiscard]] std::string ratio_text(float value);

/// "9 s", "4 min 05 s", "2 h 07 min".
[[nodiscard]] std::string duration_text(double seconds);

/// "0.100 mm", or "not judged" for infinity.
[[nodiscard]] std::string tolerance_mm(float value);

}  // namespace bladefit
