#include "tools/doctor/modbus_examination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tools/doctor/record_trials.hpp"

namespace bladefit {
namespace {

/// Units that are tried where the one of the settings is silent. A bridge may want 0 or 255.
std::vector<int> other_units(const ModbusSettings& settings) {
  std::vector<int> units;
  for (int unit = 1; unit <= 10; ++unit) units.push_back(unit);
  if (settings.transport == ModbusTransport::tcp) units.insert(units.begin(), {255, 0});
  std::erase(units, settings.unit);
  return units;
}

const RegisterReply& read_header(RegisterReader& reader, const CmmMap& map) {
  const RegisterBlock block = header_block(map);
  return reader.read(map.table, block.first, block.count);
}

/// Nothing came back, or what came cannot be a reply.
bool is_silent(const RegisterReply& reply) {
  return reply.event == LinkEvent::timeout || reply.event == LinkEvent::broken || reply.event == LinkEvent::damaged;
}

/// A device on its unit, with the link to it.
struct Device {
  ModbusSettings settings;
  std::unique_ptr<RegisterReader> reader;
};

/// Connects and finds the unit that answers. Returns nothing where none does: then `examination` says so.
std::optional<Device> reach(const ModbusSettings& settings, Deadline until, Examination& examination) {
  Device device{settings, std::make_unique<RegisterReader>(settings, until)};
  examination.outcome = Outcome::unreachable;
  if (const Failure failure = device.reader->connect()) {
    examination.conclusion = failure.message;
    return std::nullopt;
  }
  examination.seen.emplace_back(settings.transport == ModbusTransport::tcp ? "the connection is made"
                                                                           : "the port opens");
  const RegisterReply first = read_header(*device.reader, settings.map);
  if (!is_silent(first)) return device;
  examination.seen.push_back(fmt::format("unit {}: {}", settings.unit, first.fault));
  std::vector<int> units = other_units(settings);
  if (const std::optional<int> other = device.reader->other_unit()) units.insert(units.begin(), *other);
  for (const int unit : units) {
    if (std::chrono::steady_clock::now() >= until) break;
    device.reader.reset();  // its port is locked while it is open
    device.settings.unit = unit;
    device.reader = std::make_unique<RegisterReader>(device.settings, until);
    if (device.reader->connect() || is_silent(read_header(*device.reader, settings.map))) continue;
    examination.seen.push_back(fmt::format("unit {} answers", unit));
    examination.changes.push_back(fmt::format("[modbus] unit = {}", unit));
    return device;
  }
  examination.conclusion = fmt::format(
      "no unit answers of those that were tried ({} and 1 to 10); switch the device on, or correct unit and the "
      "settings "
      "of the line",
      settings.unit);
  return std::nullopt;
}

/// The first way to read the records that makes sense of them and of the design; else one that makes sense of them;
/// else nothing.
std::optional<RecordTrial> find_records(Device& device, const std::vector<HeaderTrial>& headers,
                                        const LiesOnDesign& lies_on) {
  const ModbusSettings& settings = device.settings;
  std::optional<RecordTrial> found;
  for (const HeaderTrial& header : headers) {
    if (header.header.newest == 0) continue;
    for (const MapChange& change : record_changes(settings.map, header.change)) {
      const std::optional<CmmMap> map = changed(settings.map, change);
      if (!map) continue;
      RecordTrial trial = read_records(*device.reader, *map, header, change, settings.batch);
      if (!trial.makes_sense()) continue;
      if (lies_on(trial.points)) return trial;
      if (!found) found = std::move(trial);
    }
  }
  return found;
}

void tell_records(const RecordTrial& trial, Examination& examination) {
  examination.seen.push_back("newest record: " + trial.raw);
  examination.seen.push_back(fmt::format("{} of the {} newest records are good{}", trial.points.size(), trial.asked,
                                         trial.fault.empty() ? "" : "; " + trial.fault));
  examination.points = trial.points;
}

/// Adds the changes, in the words of the device file.
void take_changes(const MapChange& change, const CmmMap& map, Examination& examination) {
  for (std::string& setting : settings_of(change, map)) examination.changes.push_back(std::move(setting));
}

/// There are headers that make sense, and no records that do.
void conclude_without_records(Device& device, const HeaderTrial& header, Examination& examination) {
  const bool counts = header.proven || size_of(header.change, device.settings.map) == 0;
  if (counts) take_changes(header.change, device.settings.map, examination);
  if (header.header.newest == 0) {
    examination.conclusion = "the device has no record yet; probe some points of the blade, then run doctor again";
    return;
  }
  const RecordTrial trial = read_records(*device.reader, header.map, header, header.change, device.settings.batch);
  tell_records(trial, examination);
  examination.conclusion = fmt::format(
      "the header makes sense, the records do not ({}); compare the registers above with the device's manual: address, "
      "size and the offsets of [map.record]",
      trial.fault.empty() ? "coordinates beyond all measure" : trial.fault);
}

}  // namespace

Examination examine_modbus(const ModbusSettings& settings, Deadline until, const LiesOnDesign& lies_on) {
  Examination examination;
  std::optional<Device> device = reach(settings, until, examination);
  if (!device) return examination;
  examination.outcome = Outcome::undecided;
  const RegisterReply& raw = read_header(*device->reader, settings.map);
  examination.seen.push_back(
      "header: " + raw_text(raw, settings.map.table, header_block(settings.map).first + settings.map.address_base));
  if (raw.good()) {
    const CmmHeader header = decode_header(raw.registers, settings.map);
    for (std::string& line : header_lines(header, settings.map)) examination.seen.push_back("  " + std::move(line));
    if (const Failure failure = check_header(header, settings.map)) examination.seen.push_back("  " + failure.message);
  }
  const std::vector<HeaderTrial> headers = try_headers(*device->reader, settings.map);
  if (headers.empty()) {
    examination.conclusion =
        "no table, order of words and bytes or address one off makes sense of the header; compare the registers above "
        "with the device's manual and correct [map]";
    return examination;
  }
  if (const std::optional<RecordTrial> records = find_records(*device, headers, lies_on)) {
    take_changes(records->change, settings.map, examination);
    tell_records(*records, examination);
    examination.outcome = Outcome::fits;
  } else {
    conclude_without_records(*device, headers.front(), examination);
  }
  if (!examination.changes.empty()) examination.outcome = Outcome::change;
  return examination;
}

}  // namespace bladefit
