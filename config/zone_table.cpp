#include "config/zone_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "config/option_kinds.hpp"

namespace bladefit {
namespace {

/// What is wrong with a name beside those before it; empty = nothing.
std::string name_fault(const std::string& name, const std::vector<ZoneSettings>& before) {
  if (name.empty()) return "is empty; give the zone a name for reports";
  if (name.size() > kMostZoneName) return fmt::format("is longer than {} characters; say it in fewer", kMostZoneName);
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; };
  if (std::ranges::any_of(name, control)) return "has a line end or a control character; write it in one line";
  if (name == kRestName) return "'rest' is what lies outside of all zones; give another name, or set rest_tolerance";
  const auto same = std::ranges::find(before, name, &ZoneSettings::name);
  if (same == before.end()) return "";
  return fmt::format("'{}' is also that of zone {}; give each its own", name, same - before.begin() + 1);
}

/// A length above 0 that must be there.
void read_limit(TableReader& table, const char* key, const char* what, Length& limit) {
  if (!table.has(key))
    return table.fail(key, fmt::format("is missing; give the {} that is allowed, such as 0.1", what));
  table.read(key, limit);
  if (table.good() && !(limit.value > 0 && limit.value <= kLargestGiven))
    table.fail(key, fmt::format("{} is out of range; give one above 0, up to {}", limit.value, kLargestGiven));
}

ZoneSettings read_zone(TableReader& table, const std::vector<ZoneSettings>& before) {
  ZoneSettings zone;
  if (!table.has("name")) table.fail("name", "is missing; give the zone a name for reports");
  table.read("name", zone.name);
  if (const std::string fault = name_fault(zone.name, before); !fault.empty()) table.fail("name", fault);
  if (!table.has("where")) table.fail("where", "is missing; write for example \"auto:5mm r/R 0.7:1.0\"");
  table.read("where", zone.where);
  if (table.good()) {
    if (const Failure error = parse_zone_place(zone.where, zone.place)) table.fail("where", error.message);
  }
  read_limit(table, kPlusKey, "excess material", zone.plus);
  read_limit(table, kMinusKey, "missing material", zone.minus);
  table.finish();
  return zone;
}

}  // namespace

void read_zone_tables(TableReader& root, std::optional<std::vector<ZoneSettings>>& zones) {
  std::vector<TableReader> tables = root.tables("zone");
  if (tables.empty()) return;
  if (tables.size() > ToleranceMap::kMaxZones) {
    return root.fail("zone", fmt::format("{} zones, at most {} are possible; put some of them together", tables.size(),
                                         ToleranceMap::kMaxZones));
  }
  std::vector<ZoneSettings> read;
  read.reserve(tables.size());
  for (TableReader& table : tables) read.push_back(read_zone(table, read));
  if (root.good()) zones = std::move(read);
}

Failure load_zones(const std::string& path, std::optional<std::vector<ZoneSettings>>& zones) {
  TomlDocument document = read_toml(path);
  if (document.error) return document.error;
  TableReader root(document, document.root, "");
  if (!root.has("zone")) {
    return bad_input(fmt::format("{}: has no table [[zone]]; write one with name, where, plus and minus", path));
  }
  read_zone_tables(root, zones);
  return document.error;
}

}  // namespace bladefit
