#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tools/simulate/faults.hpp"
#include "tools/simulate/log.hpp"
#include "tools/simulate/simulator.hpp"
#include "tools/simulate/transport.hpp"

namespace bladefit::simulate {

/// The words of all transports, in the order of their table: "modbus-tcp", "modbus-rtu", ...
[[nodiscard]] std::vector<std::string> transport_words();

/// The transport that the settings name, ready for readers; what it is given outlives it. Throws ToolError: bad_input
/// for a word that no transport has, device where the port or the terminal cannot be had.
[[nodiscard]] std::unique_ptr<Transport> make_transport(const SimulatorSettings& settings, const FaultSettings& faults,
                                                        Machine& machine, const Log& log);

}  // namespace bladefit::simulate
