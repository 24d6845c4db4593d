#include "config/map_table.hpp"

namespace bladefit {
namespace {

constexpr NumberRange kWord{0, 65535};
constexpr NumberRange kDoubleWord{0, 4294967295.0};
constexpr NumberRange kScale{-1e12, 1e12};

/// A field is `false` where the device lacks it, else a table of place, type and scale. `place` is what the file calls
/// the first register: "address" in the header, "offset" in a record.
void read_field(TableReader& table, std::string_view key, std::string_view place, NumberField& field) {
  if (table.says_absent(key)) {
    field.present = false;
    return;
  }
  std::optional<TableReader> inner = table.table(key);
  if (!inner) return;
  field.present = true;
  inner->read_whole(place, field.address, kWord);
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

void read_record(TableReader table, CmmMap& map) {
  constexpr std::string_view kPlace = "offset";
  table.read_whole("address", map.records, kWord);
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
  table.read_choice<RegisterTable>("table", map.table,
                                   {{"input", RegisterTable::input}, {"holding", RegisterTable::holding}});
  read_field(table, "version", kPlace, map.version);
  table.read_whole("expected_version", map.expected_version, kDoubleWord);
  read_field(table, "status", kPlace, map.status);
  read_field(table, "newest", kPlace, map.newest);
  read_field(table, "capacity", kPlace, map.capacity);
  table.read_whole("ring_capacity", map.ring_capacity, kWord);
  read_field(table, "record_size", kPlace, map.reported_record_size);
  read_field(table, "run_id", kPlace, map.run_id);
  read_field(table, "test_constant", kPlace, map.test_constant);
  table.read("expected_test_constant", map.expected_test_constant, NumberRange{-1e300, 1e300});
  read_field(table, "acknowledge", kPlace, map.acknowledge);
  read_field(table, "command", kPlace, map.command);
  if (auto bits = table.table("status_bits")) read_status_bits(*bits, map);
  if (auto commands = table.table("commands")) read_commands(*commands, map);
  if (auto record = table.table("record")) read_record(*record, map);
  table.finish();
}

}  // namespace bladefit
