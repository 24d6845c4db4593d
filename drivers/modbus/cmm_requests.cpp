#include "drivers/modbus/cmm_requests.hpp"

#include "drivers/modbus/number_codec.hpp"

namespace bladefit {

ModbusRequest read_request(const CmmMap& map, std::uint16_t address, std::uint16_t count) {
  ModbusRequest request;
  const bool input = map.table == RegisterTable::input;
  request.function = input ? MODBUS_FC_READ_INPUT_REGISTERS : MODBUS_FC_READ_HOLDING_REGISTERS;
  request.address = address;
  request.count = count;
  return request;
}

ModbusRequest write_request(const CmmMap& map, const NumberField& field, std::uint32_t value) {
  ModbusRequest request;
  request.count = register_count(field.type);
  request.function = request.count == 1 ? MODBUS_FC_WRITE_SINGLE_REGISTER : MODBUS_FC_WRITE_MULTIPLE_REGISTERS;
  request.address = field.address;
  encode_whole(value, field.type, map.order(), request.values);
  return request;
}

/// A device that goes on by itself is left alone, so that a short loss of the link does not make it probe anything
/// again.
std::uint16_t command_for(const CmmMap& map, const CmmHeader& header, std::uint64_t next, bool opening) {
  if (!map.command.present) return 0;
  if (next == 1) return opening || header.newest == 0 ? map.command_start : std::uint16_t{0};
  const bool behind = std::uint64_t{header.newest} + 1 < next;
  const bool active_known = map.status.present && map.probing_mask != 0;
  const bool active = (header.status & (map.probing_mask | map.finished_mask)) != 0;
  return behind || (active_known && !active) ? map.command_restart : std::uint16_t{0};
}

}  // namespace bladefit
