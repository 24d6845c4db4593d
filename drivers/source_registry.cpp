#include "drivers/source_registry.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/dro/dro_source.hpp"
#include "drivers/modbus/modbus_source.hpp"
#include "drivers/modbus/tcp_place.hpp"
#include "drivers/replay/replay_source.hpp"
#include "drivers/serial/serial_source.hpp"

namespace bladefit {
namespace {

template <typename Settings>
bool holds(const SourceSettings& settings) {
  return std::holds_alternative<Settings>(settings);
}

template <typename Settings>
SourceSettings defaults_of() {
  return Settings{};
}

template <typename Source, typename Settings>
std::unique_ptr<ProbeSource> made(const SourceSettings& settings, std::string name) {
  return std::make_unique<Source>(std::get<Settings>(settings), std::move(name));
}

template <typename Settings>
std::string device_of(const SourceSettings& settings) {
  return std::get<Settings>(settings).line.device;
}

Failure take_device(std::string_view place, SerialLineSettings& line) {
  if (place.empty()) return bad_input("the device is missing; give its path, such as /dev/ttyUSB0");
  line.device = place;
  return {};
}

template <ModbusTransport transport>
bool is_modbus_over(const SourceSettings& settings) {
  const auto* const modbus = std::get_if<ModbusSettings>(&settings);
  return modbus != nullptr && modbus->transport == transport;
}

template <ModbusTransport transport>
SourceSettings modbus_over() {
  ModbusSettings settings;
  settings.transport = transport;
  return settings;
}

Failure apply_tcp(std::string_view place, SourceSettings& settings) {
  auto& modbus = std::get<ModbusSettings>(settings);
  modbus.transport = ModbusTransport::tcp;
  return parse_tcp_place(place, "modbus-tcp", modbus.tcp);
}

Failure apply_rtu(std::string_view place, SourceSettings& settings) {
  auto& modbus = std::get<ModbusSettings>(settings);
  modbus.transport = ModbusTransport::rtu;
  return take_device(place, modbus.line);
}

std::string tcp_place_of(const SourceSettings& settings) { return tcp_place(std::get<ModbusSettings>(settings).tcp); }

/// `serial:` says where the port is; whether its lines are those of a read-out only a device file says.
bool comes_in_lines(const SourceSettings& settings) {
  return holds<SerialSettings>(settings) || holds<DroSettings>(settings);
}

Failure apply_line(std::string_view place, SourceSettings& settings) {
  auto* const dro = std::get_if<DroSettings>(&settings);
  return take_device(place, dro != nullptr ? dro->line : std::get<SerialSettings>(settings).line);
}

Failure apply_file(std::string_view place, SourceSettings& settings) {
  if (place.empty()) return bad_input("the file is missing; write replay:FILE.csv");
  std::get<ReplaySettings>(settings).file = place;
  return {};
}

/// Its messages name the file.
std::unique_ptr<ProbeSource> made_replay(const SourceSettings& settings, std::string /*name*/) {
  return std::make_unique<ReplaySource>(std::get<ReplaySettings>(settings));
}

std::string file_of(const SourceSettings& settings) { return std::get<ReplaySettings>(settings).file; }

constexpr std::array<SourceProtocol, 5> kProtocols = {{
    {.word = "modbus-tcp",
     .form = "modbus-tcp://HOST:PORT",
     .place_is_path = false,
     .defaults = modbus_over<ModbusTransport::tcp>,
     .owns = is_modbus_over<ModbusTransport::tcp>,
     .accepts = holds<ModbusSettings>,
     .apply = apply_tcp,
     .place = tcp_place_of,
     .make = made<ModbusSource, ModbusSettings>},
    {.word = "modbus-rtu",
     .form = "modbus-rtu:DEVICE",
     .place_is_path = true,
     .defaults = modbus_over<ModbusTransport::rtu>,
     .owns = is_modbus_over<ModbusTransport::rtu>,
     .accepts = holds<ModbusSettings>,
     .apply = apply_rtu,
     .place = device_of<ModbusSettings>,
     .make = made<ModbusSource, ModbusSettings>},
    {.word = "serial",
     .form = "serial:DEVICE",
     .place_is_path = true,
     .defaults = defaults_of<SerialSettings>,
     .owns = holds<SerialSettings>,
     .accepts = comes_in_lines,
     .apply = apply_line,
     .place = device_of<SerialSettings>,
     .make = made<SerialSource, SerialSettings>},
    {.word = "dro",
     .form = "",
     .place_is_path = true,
     .defaults = defaults_of<DroSettings>,
     .owns = holds<DroSettings>,
     .accepts = holds<DroSettings>,
     .apply = apply_line,
     .place = device_of<DroSettings>,
     .make = made<DroSource, DroSettings>},
    {.word = "replay",
     .form = "replay:FILE.csv",
     .place_is_path = true,
     .defaults = defaults_of<ReplaySettings>,
     .owns = holds<ReplaySettings>,
     .accepts = holds<ReplaySettings>,
     .apply = apply_file,
     .place = file_of,
     .make = made_replay},
}};

/// "a, b or c" of those that are not empty.
template <typename Text>
std::string listed(Text text) {
  std::string list;
  std::string_view last;
  for (const SourceProtocol& protocol : kProtocols) {
    if (text(protocol).empty()) continue;
    if (!last.empty()) list += (list.empty() ? "" : ", ") + std::string(last);
    last = text(protocol);
  }
  return list + (list.empty() ? "" : " or ") + std::string(last);
}

}  // namespace

std::span<const SourceProtocol> source_protocols() { return kProtocols; }

const SourceProtocol* find_protocol(std::string_view word) {
  const auto* const found = std::ranges::find(kProtocols, word, &SourceProtocol::word);
  return found == kProtocols.end() ? nullptr : found;
}

const SourceProtocol* protocol_of(const SourceSettings& settings) {
  const auto* const found =
      std::ranges::find_if(kProtocols, [&](const SourceProtocol& protocol) { return protocol.owns(settings); });
  return found == kProtocols.end() ? nullptr : found;
}

std::string source_words() {
  return listed([](const SourceProtocol& protocol) { return protocol.word; });
}

std::string source_uri_forms() {
  return listed([](const SourceProtocol& protocol) { return protocol.form; });
}

}  // namespace bladefit
