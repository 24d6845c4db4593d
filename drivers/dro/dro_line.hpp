#pragma once
#include <array>
#include <string>
#include <string_view>

#include "drivers/source_settings.hpp"

namespace bladefit {

/// Reads one read-out line such as `X +0123.4567 Y -0001.2000 Z 0000.0000` into `position` [mm].
/// Returns what is wrong in words; empty = nothing, then `position` is written.
[[nodiscard]] std::string parse_dro_line(std::string_view line, const DroSettings& settings,
                                         std::array<double, 3>& position);

}  // namespace bladefit
