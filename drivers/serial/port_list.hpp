#pragma once
#include <string>

namespace bladefit {

/// The serial ports of this machine as a phrase for messages, such as "ports here: /dev/ttyUSB0, /dev/ttyS0".
[[nodiscard]] std::string known_ports();

}  // namespace bladefit
