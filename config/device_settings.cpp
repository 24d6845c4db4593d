#include "config/device_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "config/map_table.hpp"
#include "config/table_reader.hpp"
#include "drivers/modbus/cmm_header.hpp"
#include "drivers/source_registry.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {
namespace {

constexpr NumberRange kPause{1, 600000};  ///< [ms]

/// The choices of a key that says a unit: the unit, or what it is in mm.
template <typename Value, typename Of>
void read_units(TableReader& table, Value& value, Of of) {
  std::vector<std::pair<std::string_view, Value>> choices;
  for (const Unit unit : {Unit::mm, Unit::inch, Unit::cm, Unit::metre}) choices.emplace_back(word_of(unit), of(unit));
  table.read_choice<Value>("units", value, choices);
}

void read_reconnect(TableReader& table, std::chrono::milliseconds& first, std::chrono::milliseconds& longest) {
  table.read_ms("reconnect_first_ms", first, kPause);
  table.read_ms("reconnect_longest_ms", longest, kPause);
  if (first > longest) table.fail("reconnect_longest_ms", "must not be below reconnect_first_ms");
}

void read_tcp(TableReader table, TcpSettings& tcp) {
  table.read("host", tcp.host);
  table.read_whole("port", tcp.port, {1, 65535});
  table.finish();
}

void read_line(TableReader table, SerialLineSettings& line) {
  table.read_path("device", line.device);
  table.read_whole("baud", line.baud, {1200, 4000000});
  table.read_whole("data_bits", line.data_bits, {7, 8});
  table.read_choice<Parity>("parity", line.parity, kParities);
  table.read_whole("stop_bits", line.stop_bits, {1, 2});
  table.read("low_latency", line.low_latency);
  table.finish();
}

void read_modbus(TableReader table, ModbusSettings& modbus) {
  table.read_whole("unit", modbus.unit, {0, 255});
  table.read_whole("batch", modbus.batch, {1, 125});
  table.read_ms("poll_period_ms", modbus.poll_period, {0.1, 60000});
  table.read_ms("reply_timeout_ms", modbus.reply_timeout, {1, 60000});
  table.read_ms("connect_timeout_ms", modbus.connect_timeout, {1, 60000});
  read_reconnect(table, modbus.reconnect_first, modbus.reconnect_longest);
  table.read_ms("quiet_ms", modbus.quiet, {0, 60000});
  table.read_whole("timeouts_to_reconnect", modbus.timeouts_to_reconnect, {1, 1000});
  table.read_whole("record_tries", modbus.record_tries, {2, 1000000});
  table.read("echo", modbus.echo);
  table.finish();
}

void read_serial(TableReader table, SerialSettings& serial) {
  table.read_ms("start_interval_ms", serial.start_interval, {10, 60000});
  table.read_ms("resend_interval_ms", serial.resend_interval, {10, 60000});
  table.read_ms("resend_pause_ms", serial.resend_pause, {1, 60000});
  table.read_ms("silence_ms", serial.silence, {10, 600000});
  table.read_ms("open_timeout_ms", serial.open_timeout, {10, 600000});
  read_reconnect(table, serial.reconnect_first, serial.reconnect_longest);
  table.read_whole("resend_tries", serial.resend_tries, {1, 1000000});
  table.read("echo", serial.echo);
  table.finish();
}

/// `order` must have each of x, y and z once.
void check_order(TableReader& table, const std::string& order) {
  std::string sorted = order;
  std::sort(sorted.begin(), sorted.end());
  if (sorted != "xyz")
    table.fail("order", fmt::format("'{}' must have each of x, y and z once, such as \"xyz\"", order));
}

/// A mark must not be taken for a label or a number.
void check_marks(TableReader& table, const std::string& marks) {
  const std::size_t wrong = marks.find_first_of("xyzXYZ0123456789+-.,");
  if (wrong != std::string::npos)
    table.fail("marks", fmt::format("has '{}', which labels and numbers are made of; take it out", marks[wrong]));
}

void read_dro(TableReader table, DroSettings& dro) {
  read_units(table, dro.mm_per_unit, [](Unit unit) { return mm_per_unit(unit); });
  table.read("scale", dro.scale, NumberRange{1e-12, 1e12});
  dro.order_given = table.has("order");
  table.read("order", dro.order);
  check_order(table, dro.order);
  table.read("labels", dro.labels);
  table.read_choice<DroLayout>(
      "line_holds", dro.layout,
      {{"auto", DroLayout::open}, {"point", DroLayout::whole_points}, {"axis", DroLayout::single_axes}});
  if (!dro.labels && dro.layout == DroLayout::single_axes) {
    table.fail("line_holds",
               "is \"axis\" without labels: a lost line would mix two points; let the read-out send labels");
  }
  table.read("separators", dro.separators);
  if (dro.separators.empty()) table.fail("separators", "is empty; name at least one character, such as \" \"");
  table.read_choice<char>("decimal_mark", dro.decimal_mark, {{".", '.'}, {",", ','}});
  if (dro.separators.find(dro.decimal_mark) != std::string::npos) {
    table.fail("separators", fmt::format("has the decimal mark '{}'; take it out", dro.decimal_mark));
  }
  table.read("fixed_decimals", dro.fixed_decimals);
  table.read("marks", dro.marks);
  check_marks(table, dro.marks);
  table.read("ignore_prefix", dro.ignore_prefix);
  read_reconnect(table, dro.reconnect_first, dro.reconnect_longest);
  table.finish();
}

void read_replay(TableReader table, ReplaySettings& replay) {
  table.read_path("file", replay.file);
  read_units(table, replay.format.given_unit, [](Unit unit) { return unit; });
  table.read("columns", replay.format.columns);
  if (const Failure failure = replay.format.columns.empty() ? Failure{} : check_point_columns(replay.format.columns))
    table.fail("columns", failure.message);
  table.finish();
}

/// Only the tables of the kind are asked for, so that one of another kind is an unknown key.
struct TablesReader {
  TableReader& root;

  void operator()(std::monostate) const { root.fail("kind", "is missing; set it to " + source_words()); }

  /// Both transports are read: a URI may choose the other one.
  void operator()(ModbusSettings& modbus) const {
    if (auto table = root.table("tcp")) read_tcp(*table, modbus.tcp);
    if (auto table = root.table("line")) read_line(*table, modbus.line);
    if (auto table = root.table("modbus")) read_modbus(*table, modbus);
    if (auto table = root.table("map")) read_map_table(*table, modbus.map);
    if (!root.good()) return;
    if (const Failure failure = check_map(modbus.map)) root.fail("map", failure.message);
  }

  void operator()(SerialSettings& serial) const {
    if (auto table = root.table("line")) read_line(*table, serial.line);
    if (auto table = root.table("serial")) read_serial(*table, serial);
  }

  void operator()(DroSettings& dro) const {
    if (auto table = root.table("line")) read_line(*table, dro.line);
    if (auto table = root.table("dro")) read_dro(*table, dro);
  }

  void operator()(ReplaySettings& replay) const {
    if (auto table = root.table("replay")) read_replay(*table, replay);
  }
};

/// The defaults of the protocol that `kind` names.
void read_kind(TableReader& root, SourceSettings& settings) {
  std::vector<std::pair<std::string_view, const SourceProtocol*>> kinds;
  for (const SourceProtocol& protocol : source_protocols()) kinds.emplace_back(protocol.word, &protocol);
  const SourceProtocol* kind = nullptr;
  root.read_choice<const SourceProtocol*>("kind", kind, kinds);
  if (kind != nullptr) settings = kind->defaults();
}

}  // namespace

Failure load_device(const std::string& path, SourceSettings& settings) {
  TomlDocument document = read_toml(path);
  if (document.error) return document.error;
  SourceSettings read;
  TableReader root(document, document.root, "");
  read_kind(root, read);
  if (root.good()) std::visit(TablesReader{root}, read);
  root.finish();
  if (!document.error) settings = std::move(read);
  return document.error;
}

}  // namespace bladefit
