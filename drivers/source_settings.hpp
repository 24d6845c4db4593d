#pragma once
#include <variant>

#include "drivers/dro/dro_settings.hpp"
#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/replay/replay_settings.hpp"
#include "drivers/serial/serial_settings.hpp"

namespace bladefit {

/// Where the points come from: the settings of one protocol. std::monostate: nobody has said it yet.
using SourceSettings = std::variant<std::monostate, ModbusSettings, SerialSettings, DroSettings, ReplaySettings>;

}  // namespace bladefit
