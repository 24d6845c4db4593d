#include "tools/doctor/map_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "drivers/modbus/cmm_header.hpp"

namespace bladefit {
namespace {

constexpr std::array<int, 3> kShifts = {0, -1, 1};

/// Moves an address; false where there is no such register.
bool shift(std::uint16_t& address, int by) {
  const int moved = address + by;
  if (moved < 0 || moved > 65535) return false;
  address = static_cast<std::uint16_t>(moved);
  return true;
}

void sort_by_size(std::vector<MapChange>& changes, const CmmMap& map) {
  std::ranges::stable_sort(changes, {}, [&map](const MapChange& change) { return size_of(change, map); });
}

/// How the addresses of the file have to be counted; empty where the count is right.
std::string address_setting(const MapChange& change, const CmmMap& map) {
  const int header = change.header_shift, records = change.record_shift, base = map.address_base;
  if (header == 0 && records == 0) return "";
  const auto corrected = [base](int address, int by) { return address + base + by; };
  if (header == records) {
    if (header == -1 && base == 0) return "[map] address_base = 1";
    if (header == 1 && base == 1) return "[map] address_base = 0";
    return fmt::format("[map] every address {} by one: newest = {{ address = {} }}", header > 0 ? "higher" : "lower",
                       corrected(map.newest.address, header));
  }
  std::string text;
  if (header != 0) {
    text = fmt::format("[map] the addresses of the header fields {} by one: newest = {{ address = {} }}",
                       header > 0 ? "higher" : "lower", corrected(map.newest.address, header));
  }
  if (records == 0) return text;
  return fmt::format("{}{}[map.record] address = {}", text, text.empty() ? "" : ", ", corrected(map.records, records));
}

}  // namespace

MapChange unchanged(const CmmMap& map) { return {.table = map.table, .order = map.order()}; }

std::vector<MapChange> header_changes(const CmmMap& map) {
  std::vector<MapChange> changes;
  for (const auto& [table_word, table] : kRegisterTables) {
    for (const auto& [word_name, words] : kWordOrders) {
      for (const auto& [byte_name, bytes] : kByteOrders) {
        for (const int by : kShifts)
          changes.push_back({.table = table, .order = {words, bytes}, .header_shift = by, .record_shift = by});
      }
    }
  }
  sort_by_size(changes, map);
  return changes;
}

std::vector<MapChange> record_changes(const CmmMap& map, const MapChange& header) {
  std::vector<MapChange> changes;
  for (const int by : kShifts) {
    for (const bool without_crc : {false, true}) {
      if (without_crc && !map.crc.present) continue;
      MapChange change = header;
      change.record_shift = by;
      change.without_crc = without_crc;
      changes.push_back(change);
    }
  }
  sort_by_size(changes, map);
  return changes;
}

int size_of(const MapChange& change, const CmmMap& map) {
  int size = change.table != map.table ? 1 : 0;
  size += change.order.words != map.word_order ? 1 : 0;
  size += change.order.bytes != map.byte_order ? 1 : 0;
  size += change.header_shift != 0 || change.record_shift != 0 ? 1 : 0;
  size += change.header_shift != change.record_shift ? 1 : 0;
  return size + (change.without_crc ? 2 : 0);
}

std::optional<CmmMap> changed(const CmmMap& map, const MapChange& change) {
  CmmMap result = map;
  result.table = change.table;
  result.word_order = change.order.words;
  result.byte_order = change.order.bytes;
  bool possible = shift(result.records, change.record_shift);
  for (NumberField* field : {&result.version, &result.status, &result.newest, &result.capacity,
                             &result.reported_record_size, &result.run_id, &result.test_constant}) {
    if (field->present) possible = shift(field->address, change.header_shift) && possible;
  }
  if (change.without_crc) result.crc.present = false;
  if (!possible || check_map(result)) return std::nullopt;
  return result;
}

std::vector<std::string> settings_of(const MapChange& change, const CmmMap& map) {
  std::vector<std::string> settings;
  if (change.table != map.table) {
    const auto* const named =
        std::ranges::find(kRegisterTables, change.table, &std::pair<std::string_view, RegisterTable>::second);
    settings.push_back(fmt::format("[map] table = \"{}\"", named->first));
  }
  if (const std::string order = order_settings(map, change.order); !order.empty()) settings.push_back("[map] " + order);
  if (std::string address = address_setting(change, map); !address.empty()) settings.push_back(std::move(address));
  if (change.without_crc) settings.emplace_back("[map.record] crc = false, or the place of the device's own check sum");
  return settings;
}

}  // namespace bladefit
