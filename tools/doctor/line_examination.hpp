#pragma once
#include <variant>

#include "drivers/dro/dro_settings.hpp"
#include "drivers/serial/serial_settings.hpp"
#include "tools/doctor/examination.hpp"

namespace bladefit {

/// Listens to a device that speaks in lines: with the settings as they are, then as a device of the other kind, with
/// another format of the lines, with the parity in the eighth bit, at other rates. Nothing is sent: a machine that
/// speaks only when it is started stays silent.
[[nodiscard]] Examination examine_line(const std::variant<SerialSettings, DroSettings>& settings, Deadline until);

}  // namespace bladefit
