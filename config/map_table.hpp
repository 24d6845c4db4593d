#pragma once
#include "config/table_reader.hpp"
#include "drivers/modbus/modbus_settings.hpp"

namespace bladefit {

/// Reads the table [map] of a device file; what is wrong in it is kept in the reader's document.
void read_map_table(TableReader& table, CmmMap& map);

}  // namespace bladefit
