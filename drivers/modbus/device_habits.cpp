#include "drivers/modbus/device_habits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/modbus/cmm_header.hpp"
#include "drivers/modbus/number_codec.hpp"

namespace bladefit {
namespace {

bool overlaps(const NumberField& field, std::uint32_t first, std::uint32_t count) {
  return field.address < first + count && first < std::uint32_t{field.address} + register_count(field.type);
}

/// Whether writing `field` would change what is read: the header, or the ring as far as its length is known.
bool is_read(const NumberField& field, const CmmMap& map) {
  if (map.table != RegisterTable::holding) return false;
  const RegisterBlock header = header_block(map);
  const std::uint32_t ring = std::max<std::uint32_t>(map.ring_capacity, 1) * map.record_size;
  return overlaps(field, header.first, header.count) || overlaps(field, map.records, ring);
}

}  // namespace

std::vector<std::string> give_up_unsafe_writes(CmmMap& map) {
  std::vector<std::string> remarks;
  const auto look_at = [&](NumberField& field, const char* key, const char* meaning) {
    if (field.present && is_read(field, map)) {
      field.present = false;
      remarks.push_back(
          fmt::format("{} is not written: register {} is one of those read; give {} a place of its own in "
                      "the device file; until then {}",
                      key, field.address, key, meaning));
    } else if (!field.present) {
      remarks.push_back(fmt::format("the device file has no {} register: {}", key, meaning));
    }
  };
  look_at(map.acknowledge, "acknowledge", "points that the device overwrites before they are read are lost");
  look_at(map.command, "command", "start and stop the program at the machine");
  return remarks;
}

std::vector<std::string> read_holding_instead(CmmMap& map) {
  if (map.table == RegisterTable::holding) return {};
  map.table = RegisterTable::holding;
  std::vector<std::string> remarks = {
      "the device does not know function 4: its holding registers are read with function 3 (table = \"holding\" in the "
      "device file does so at once)"};
  for (std::string& remark : give_up_unsafe_writes(map)) remarks.push_back(std::move(remark));
  return remarks;
}

std::vector<std::string> give_up_writing(NumberField& field, const std::string& fault) {
  field.present = false;
  return {
      fmt::format("{}; nothing is written there from now on: correct the address, or say acknowledge = false or "
                  "command = false in the device file",
                  fault)};
}

std::string silence_text(int unit, std::optional<int> other_unit) {
  if (other_unit) {
    return fmt::format("unit {0} answers in place of unit {1}; set unit = {0} in the device file", *other_unit, unit);
  }
  return fmt::format("unit {} does not answer; switch it on, or correct unit and the settings of the line", unit);
}

}  // namespace bladefit
