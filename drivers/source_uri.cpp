#include "drivers/source_uri.hpp"

#include <fmt/format.h>

#include <optional>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kForms = "modbus-tcp://HOST:PORT, modbus-rtu:DEVICE, serial:DEVICE or replay:FILE.csv";

std::string wrong(std::string_view uri, std::string_view what) { return fmt::format("source '{}': {}", uri, what); }

bool speaks_modbus(SourceKind kind) { return kind == SourceKind::modbus_tcp || kind == SourceKind::modbus_rtu; }

bool speaks_lines(SourceKind kind) { return kind == SourceKind::serial || kind == SourceKind::dro; }

/// A device file and a URI must speak the same protocol.
std::string check_kind(std::string_view uri, SourceKind wanted, SourceKind described) {
  if (described == SourceKind::none || described == wanted) return {};
  if (speaks_modbus(described) && speaks_modbus(wanted)) return {};
  if (speaks_lines(described) && speaks_lines(wanted)) return {};
  return wrong(uri, "the device file describes another transport; leave out one of the two");
}

std::string apply_tcp(std::string_view uri, std::string_view rest, SourceSettings& settings) {
  if (!rest.starts_with("//")) return wrong(uri, "'//' is missing; write modbus-tcp://HOST:PORT");
  rest.remove_prefix(2);
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos || rest.ends_with(']')) {
    return wrong(uri, "the port is missing; write modbus-tcp://HOST:PORT");
  }
  std::string_view host = rest.substr(0, colon);
  const std::optional<std::uint16_t> port = parse_whole<std::uint16_t>(rest.substr(colon + 1));
  if (!port || *port == 0) return wrong(uri, "the port is not a whole number 1..65535");
  const bool bracketed = host.starts_with('[') && host.ends_with(']');
  if (bracketed) host = host.substr(1, host.size() - 2);
  if (host.empty()) return wrong(uri, "the host is missing; write modbus-tcp://HOST:PORT");
  if (!bracketed && host.find(':') != std::string_view::npos) {
    return wrong(uri, "the host has a ':'; put an IPv6 address into brackets");
  }
  if (host.find_first_of("/@ ") != std::string_view::npos)
    return wrong(uri, "the host has a character that no host has");
  settings.tcp = {std::string(host), *port};
  settings.kind = SourceKind::modbus_tcp;
  return {};
}

std::string apply_device(std::string_view uri, std::string_view device, SourceKind kind, SourceSettings& settings) {
  if (device.empty()) return wrong(uri, "the device is missing; give its path, such as /dev/ttyUSB0");
  settings.line.device = device;
  if (kind != SourceKind::serial || settings.kind != SourceKind::dro) settings.kind = kind;
  return {};
}

}  // namespace

std::string apply_source_uri(std::string_view uri, SourceSettings& settings) {
  const std::size_t colon = uri.find(':');
  const std::string_view scheme = uri.substr(0, colon);
  const std::string_view rest = colon == std::string_view::npos ? std::string_view{} : uri.substr(colon + 1);
  SourceKind kind = SourceKind::none;
  if (colon != std::string_view::npos) {
    if (scheme == "modbus-tcp") kind = SourceKind::modbus_tcp;
    if (scheme == "modbus-rtu") kind = SourceKind::modbus_rtu;
    if (scheme == "serial") kind = SourceKind::serial;
    if (scheme == "replay") kind = SourceKind::replay;
  }
  if (kind == SourceKind::none) return wrong(uri, fmt::format("unknown transport; write {}", kForms));
  if (std::string error = check_kind(uri, kind, settings.kind); !error.empty()) return error;
  if (kind == SourceKind::modbus_tcp) return apply_tcp(uri, rest, settings);
  if (kind != SourceKind::replay) return apply_device(uri, rest, kind, settings);
  if (rest.empty()) return wrong(uri, "the file is missing; write replay:FILE.csv");
  settings.replay.file = rest;
  settings.kind = kind;
  return {};
}

std::string source_name(const SourceSettings& settings) {
  switch (settings.kind) {
    case SourceKind::none:
      break;
    case SourceKind::modbus_tcp:
      if (settings.tcp.host.find(':') == std::string::npos) {
        return fmt::format("modbus-tcp://{}:{}", settings.tcp.host, settings.tcp.port);
      }
      return fmt::format("modbus-tcp://[{}]:{}", settings.tcp.host, settings.tcp.port);
    case SourceKind::modbus_rtu:
      return "modbus-rtu:" + settings.line.device;
    case SourceKind::serial:
      return "serial:" + settings.line.device;
    case SourceKind::dro:
      return "dro:" + settings.line.device;
    case SourceKind::replay:
      return "replay:" + settings.replay.file;
  }
  return "no source";
}

}  // namespace bladefit
