#pragma once
#include <functional>

#include "drivers/modbus/modbus_settings.hpp"
#include "tools/doctor/examination.hpp"

namespace bladefit {

/// Whether points lie on the design; true where that cannot be told.
using LiesOnDesign = std::function<bool(const std::vector<ProbePoint>&)>;

/// Looks at a device with a register map: with the settings as they are, then with other units, tables, orders and
/// addresses, until one makes sense of its header and its records. Where several do, one whose points lie on the design
/// is taken, and of these the one with the fewest changes.
[[nodiscard]] Examination examine_modbus(const ModbusSettings& settings, Deadline until, const LiesOnDesign& lies_on);

}  // namespace bladefit
