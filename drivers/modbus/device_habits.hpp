#pragma once
#include <optional>
#include <string>
#include <vector>

#include "drivers/modbus/modbus_settings.hpp"

namespace bladefit {

/// What the user should know of a map before its device is asked for anything: registers that are missing to write to,
/// each a remark. A register to write to that is one of those that are read is given up.
[[nodiscard]] std::vector<std::string> give_up_unsafe_writes(CmmMap& map);

/// The device does not know the function that reads. Its holding registers are read in place of its input registers.
/// Returns the remarks on it; none where the holding registers were read already, so that there is no other way.
[[nodiscard]] std::vector<std::string> read_holding_instead(CmmMap& map);

/// The device takes no writes to a field of its map: `fault` says why. Returns the remark on it.
[[nodiscard]] std::vector<std::string> give_up_writing(NumberField& field, const std::string& fault);

/// Why the device is as good as absent: it is silent, or another unit answers in its place.
[[nodiscard]] std::string silence_text(int unit, std::optional<int> other_unit);

}  // namespace bladefit
