#include "tools/simulate/modbus_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "tools/files/tool_error.hpp"
#include "tools/simulate/check_sum.hpp"

namespace bladefit::simulate {
namespace {

void put_float64(std::span<std::uint16_t> registers, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned word = 0; word < 4; ++word) registers[word] = static_cast<std::uint16_t>(bits >> (48U - 16U * word));
}

std::uint32_t get_uint32(std::span<const std::uint16_t> registers) {
  return static_cast<std::uint32_t>(registers[0]) << 16U | registers[1];
}

/// CRC over the bytes of the registers, the high byte of each first.
std::uint16_t record_check_sum(std::span<const std::uint16_t> registers) {
  std::string bytes;
  for (const std::uint16_t value : registers) {
    bytes.push_back(static_cast<char>(value >> 8U));
    bytes.push_back(static_cast<char>(value & 0xFFU));
  }
  return check_sum(bytes, cmm_map_v1::kCrcInitial, cmm_map_v1::kCrcPolynomial);
}

std::uint16_t status_bits(const Machine& machine) {
  unsigned bits = machine.probing() ? cmm_map_v1::kStatusProbing : cmm_map_v1::kStatusReady;
  if (machine.overflowed()) bits |= cmm_map_v1::kStatusOverflow;
  if (machine.finished()) bits |= cmm_map_v1::kStatusFinished;
  return static_cast<std::uint16_t>(bits);
}

}  // namespace

void put_uint32(std::span<std::uint16_t> registers, std::uint32_t value) {
  registers[0] = static_cast<std::uint16_t>(value >> 16U);
  registers[1] = static_cast<std::uint16_t>(value & 0xFFFFU);
}

RecordRegisters encode_record(std::uint32_t sequence, const MachinePoint& point) {
  namespace map = cmm_map_v1;
  RecordRegisters record{};
  const std::span<std::uint16_t> registers(record);
  put_uint32(registers.subspan(map::kSequenceOffset, 2), sequence);
  put_float64(registers.subspan(map::kXOffset, 4), point.position_mm[0]);
  put_float64(registers.subspan(map::kYOffset, 4), point.position_mm[1]);
  put_float64(registers.subspan(map::kZOffset, 4), point.position_mm[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto scaled = static_cast<std::int16_t>(std::lround(point.direction[axis] * map::kDirectionScale));
    registers[map::kDirectionOffset + axis] = static_cast<std::uint16_t>(scaled);
  }
  registers[map::kPathOffset] = point.path;
  registers[map::kRecordStatusOffset] = map::kRecordGood;
  registers[map::kCrcOffset] = record_check_sum(registers.first(map::kCrcOffset));
  return record;
}

ModbusMap::ModbusMap(const Machine& machine, std::uint16_t version) : capacity_(machine.settings().capacity) {
  const unsigned input_registers = cmm_map_v1::kRecordsRegister + capacity_ * cmm_map_v1::kRecordSize;
  mapping_.reset(modbus_mapping_new_start_address(0, 0, 0, 0, 0, cmm_map_v1::kHoldingSize, 0, input_registers));
  if (!mapping_) throw ToolError("no memory for the register map; give a smaller --capacity", ToolError::Kind::device);
  const std::span<std::uint16_t> registers = header();
  registers[cmm_map_v1::kVersionRegister] = version;
  registers[cmm_map_v1::kCapacityRegister] = static_cast<std::uint16_t>(capacity_);
  registers[cmm_map_v1::kRecordSizeRegister] = cmm_map_v1::kRecordSize;
  put_uint32(registers.subspan(cmm_map_v1::kRunIdRegister, 2), machine.settings().run_id);
  put_float64(registers.subspan(cmm_map_v1::kTestConstantRegister, 4), cmm_map_v1::kTestConstant);
  publish(machine);
}

std::span<std::uint16_t> ModbusMap::header() { return {mapping_->tab_input_registers, cmm_map_v1::kHeaderSize}; }

std::span<std::uint16_t> ModbusMap::slot(std::uint32_t sequence) {
  const std::size_t offset = cmm_map_v1::kRecordsRegister + (sequence - 1) % capacity_ * cmm_map_v1::kRecordSize;
  return {mapping_->tab_input_registers + offset, cmm_map_v1::kRecordSize};
}

void ModbusMap::publish(const Machine& machine) {
  if (machine.available() < published_) published_ = machine.available();
  while (published_ < machine.available()) {
    ++published_;
    const RecordRegisters record = encode_record(published_, machine.point(published_));
    std::copy(record.begin(), record.end(), slot(published_).begin());
  }
  put_uint32(header().subspan(cmm_map_v1::kNewestRegister, 2), published_);
  header()[cmm_map_v1::kStatusRegister] = status_bits(machine);
}

std::uint16_t ModbusMap::obey(Machine& machine, Clock::time_point now) {
  const std::span<std::uint16_t> holding(mapping_->tab_registers, cmm_map_v1::kHoldingSize);
  const std::uint32_t acknowledged = get_uint32(holding.subspan(cmm_map_v1::kAcknowledgeRegister, 2));
  if (acknowledged != machine.acknowledged() && !machine.acknowledge(acknowledged)) {
    put_uint32(holding.subspan(cmm_map_v1::kAcknowledgeRegister, 2), machine.acknowledged());
  }
  const std::uint16_t command = std::exchange(holding[cmm_map_v1::kCommandRegister], std::uint16_t{0});
  if (command == cmm_map_v1::kCommandStart) machine.start(now);
  if (command == cmm_map_v1::kCommandStop) machine.stop();
  if (command == cmm_map_v1::kCommandRestart) machine.restart(now);
  return command;
}

}  // namespace bladefit::simulate
