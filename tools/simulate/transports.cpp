#include "tools/simulate/transports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "tools/files/tool_error.hpp"
#include "tools/simulate/modbus_rtu_transport.hpp"
#include "tools/simulate/modbus_tcp_transport.hpp"
#include "tools/simulate/serial_transport.hpp"

namespace bladefit::simulate {
namespace {

using Made = std::unique_ptr<Transport>;

Made modbus_tcp(const SimulatorSettings& settings, const FaultSettings& faults, Machine& machine, const Log& log) {
  return std::make_unique<ModbusTcpTransport>(machine, settings.port, settings.map_version, faults, log);
}

Made modbus_rtu(const SimulatorSettings& settings, const FaultSettings& faults, Machine& machine, const Log& log) {
  return std::make_unique<ModbusRtuTransport>(machine, settings.device, settings.unit, settings.map_version, faults,
                                              log);
}

Made serial(const SimulatorSettings& settings, const FaultSettings& faults, Machine& machine, const Log& log) {
  return std::make_unique<SerialTransport>(machine, settings.device, faults, log);
}

struct TransportRow {
  std::string_view word;  ///< on the command line
  Made (*make)(const SimulatorSettings&, const FaultSettings&, Machine&, const Log&);
};

/// All transports. A new one is a pair of files and a row here.
constexpr std::array<TransportRow, 3> kTransports{
    {{"modbus-tcp", modbus_tcp}, {"modbus-rtu", modbus_rtu}, {"serial", serial}}};

}  // namespace

std::vector<std::string> transport_words() {
  std::vector<std::string> words;
  words.reserve(kTransports.size());
  for (const TransportRow& row : kTransports) words.emplace_back(row.word);
  return words;
}

std::unique_ptr<Transport> make_transport(const SimulatorSettings& settings, const FaultSettings& faults,
                                          Machine& machine, const Log& log) {
  const auto* const row = std::ranges::find(kTransports, settings.transport, &TransportRow::word);
  if (row != kTransports.end()) return row->make(settings, faults, machine, log);
  throw ToolError(
      fmt::format("--transport {}: is none; give one of {}", settings.transport, fmt::join(transport_words(), ", ")));
}

}  // namespace bladefit::simulate
