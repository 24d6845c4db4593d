#pragma once
#include <modbus/modbus.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/modbus/cmm_map_v1.hpp"
#include "tools/simulate/machine.hpp"

namespace bladefit::simulate {

using RecordRegisters = std::array<std::uint16_t, cmm_map_v1::kRecordSize>;

/// The registers of a record, its check sum included.
[[nodiscard]] RecordRegisters encode_record(std::uint32_t sequence, const MachinePoint& point);

/// Two registers, high word first.
void put_uint32(std::span<std::uint16_t> registers, std::uint32_t value);

/// The machine as registers of CMM map v1.
class ModbusMap {
 public:
  /// `version` is what register 0 says. Throws ToolError (device) when there is no memory for the map.
  ModbusMap(const Machine& machine, std::uint16_t version);

  /// Writes the records that have become available, then the header that announces them.
  void publish(const Machine& machine);

  /// Obeys the acknowledge and the command that a reader has written. The command register goes back to 0, so that the
  /// same command can be given again. Returns the command, 0 = none.
  std::uint16_t obey(Machine& machine, Clock::time_point now);

  [[nodiscard]] modbus_mapping_t* mapping() { return mapping_.get(); }

  /// Input registers of the record of a sequence number.
  [[nodiscard]] std::span<std::uint16_t> slot(std::uint32_t sequence);
  [[nodiscard]] std::span<std::uint16_t> header();
  [[nodiscard]] std::uint32_t capacity() const { return capacity_; }

 private:
  struct FreeMapping {
    void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
  };

  std::unique_ptr<modbus_mapping_t, FreeMapping> mapping_;
  std::uint32_t capacity_;
  std::uint32_t published_ = 0;
};

}  // namespace bladefit::simulate
