#include "config/map_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace bladefit {
namespace {

constexpr NumberRange kWord{0, 65535};
constexpr NumberRange kDoubleWord{0, 4294967295.0};
constexpr NumberRange kScale{-1e12, 1e12};

/// A register of the device, counted from `base` in the file and from 0 on the line.
void read_address(TableReader& table, std::string_view key, std::uint16_t base, std::uint16_t& address) {
  std::uint32_t written = std::uint32_t{address} + base;
  table.read_whole(key, written, {static_cast<double>(base), 65535.0 + base});
  address = static_cast<std::uint16_t>(written - base);
}

/// A field is `false` where the device lacks it, else a table of place, type and scale. `place` is what the file calls
/// the first register: "address" in the header, counted from `base`, "offset" in a record.
void read_field(TableReader& table, std::string_view key, std::string_view place, NumberField& field,
                std::uint16_t base = 0) {
  if (table.says_absent(key)) {
    field.present = false;
    return;
  }
  std::optional<TableReader> inner = table.table(key);
  if (!inner) return;
  field.present = true;
  read_address(*inner, place, base, field.address);
  inner->read_choice<NumberType>("type", field.type,
                                 {{"uint16", NumberType::uint16},
                                  {"int16", NumberType::int16},
                                  {"uint32", NumberType::uint32},
                                  {"int32", NumberType::int32},
                                  {"float32", NumberType::float32},
                                  {"float64", NumberType::float64}});
  inner->read("scale", field.scale, kScale);
  if (field.scale == 0) inner->fail("scale", "is 0; give the value of one count");
  inner->finish();
}

void read_record(TableReader table, std::uint16_t base, CmmMap& map) {
  constexpr std::string_view kPlace = "offset";
  read_address(table, "address", base, map.records);
  table.read_whole("size", map.record_size, {1, 125});
  read_field(table, "sequence", kPlace, map.sequence);
  read_field(table, "x", kPlace, map.position[0]);
  read_field(table, "y", kPlace, map.position[1]);
  read_field(table, "z", kPlace, map.position[2]);
  read_field(table, "i", kPlace, map.direction[0]);
  read_field(table, "j", kPlace, map.direction[1]);
  read_field(table, "k", kPlace, map.direction[2]);
  read_field(table, "path", kPlace, map.path);
  read_field(table, "status", kPlace, map.record_status);
  table.read_whole("good_status", map.record_good, kDoubleWord);
  read_field(table, "crc", kPlace, map.crc);
  table.finish();
}

void read_status_bits(TableReader table, CmmMap& map) {
  table.read_whole("probing", map.probing_mask, kWord);
  table.read_whole("fault", map.fault_mask, kWord);
  table.read_whole("overflow", map.overflow_mask, kWord);
  table.read_whole("finished", map.finished_mask, kWord);
  table.finish();
}

/// A status that is a number: which value, or values, mean what. What is left out the device does not tell.
void read_status_values(TableReader table, CmmMap& map) {
  const CmmMap bits;
  const auto read_meaning = [&](std::string_view key, std::uint16_t bit) {
    std::vector<std::uint16_t> values;
    table.read_wholes(key, values, kWord);
    for (const std::uint16_t value : values) {
      const auto same = std::ranges::find(map.status_values, value, &std::pair<std::uint16_t, std::uint16_t>::second);
      if (same != map.status_values.end())
        table.fail(key, fmt::format("shares the value {} with another key; a value has one meaning", value));
      map.status_values.emplace_back(bit, value);
    }
    return values.empty() ? std::uint16_t{0} : bit;
  };
  static_cast<void>(read_meaning("ready", 0));
  map.probing_mask = read_meaning("probing", bits.probing_mask);
  map.fault_mask = read_meaning("fault", bits.fault_mask);
  map.overflow_mask = read_meaning("overflow", bits.overflow_mask);
  map.finished_mask = read_meaning("finished", bits.finished_mask);
  table.finish();
}

void read_commands(TableReader table, CmmMap& map) {
  table.read_whole("start", map.command_start, kWord);
  table.read_whole("stop", map.command_stop, kWord);
  table.read_whole("restart", map.command_restart, kWord);
  table.finish();
}

}  // namespace

void read_map_table(TableReader& table, CmmMap& map) {
  constexpr std::string_view kPlace = "address";
  table.read_choice<WordOrder>("word_order", map.word_order, kWordOrders);
  table.read_choice<ByteOrder>("byte_order", map.byte_order, kByteOrders);
  table.read_whole("address_base", map.address_base, {0, 1});
  const std::uint16_t base = map.address_base;
  table.read_choice<RegisterTable>("table", map.table, kRegisterTables);
  read_field(table, "version", kPlace, map.version, base);
  table.read_whole("expected_version", map.expected_version, kDoubleWord);
  read_field(table, "status", kPlace, map.status, base);
  read_field(table, "newest", kPlace, map.newest, base);
  read_field(table, "capacity", kPlace, map.capacity, base);
  table.read_whole("ring_capacity", map.ring_capacity, kWord);
  read_field(table, "record_size", kPlace, map.reported_record_size, base);
  read_field(table, "run_id", kPlace, map.run_id, base);
  read_field(table, "test_constant", kPlace, map.test_constant, base);
  table.read("expected_test_constant", map.expected_test_constant, NumberRange{-1e300, 1e300});
  read_field(table, "acknowledge", kPlace, map.acknowledge, base);
  read_field(table, "command", kPlace, map.command, base);
  auto bits = table.table("status_bits");
  auto values = table.table("status_values");
  if (bits && values)
    table.fail("status_values", "stands beside status_bits; the status is a number or bits: keep one");
  if (bits) read_status_bits(*bits, map);
  if (values) read_status_values(*values, map);
  if (auto commands = table.table("commands")) read_commands(*commands, map);
  if (auto record = table.table("record")) read_record(*record, base, map);
  table.finish();
}

}  // namespace bladefit
