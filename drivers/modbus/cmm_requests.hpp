#pragma once
#include <cstdint>

#include "drivers/modbus/cmm_header.hpp"
#include "drivers/modbus/modbus_frame.hpp"
#include "drivers/modbus/modbus_settings.hpp"

namespace bladefit {

/// Reads registers of the table that holds the header and the records.
[[nodiscard]] ModbusRequest read_request(const CmmMap& map, std::uint16_t address, std::uint16_t count);

/// Writes `value` to a field of the holding registers.
[[nodiscard]] ModbusRequest write_request(const CmmMap& map, const NumberField& field, std::uint32_t value);

/// The command that a device which shows `header` needs, so that it probes record `next`; 0 = none. `opening`: the
/// session begins, rather than the link came back.
[[nodiscard]] std::uint16_t command_for(const CmmMap& map, const CmmHeader& header, std::uint64_t next, bool opening);

}  // namespace bladefit
