#pragma once
#include <array>
#include <string_view>

#include "drivers/dro/dro_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Reads one read-out line such as `X +0123.4567 Y -0001.2000 Z 0000.0000` into `position` [mm].
/// bad_input: what is wrong in words; then `position` is as before.
[[nodiscard]] Failure parse_dro_line(std::string_view line, const DroSettings& settings,
                                     std::array<double, 3>& position);

}  // namespace bladefit
