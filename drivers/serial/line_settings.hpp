#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "drivers/serial/protocol_v1.hpp"

namespace bladefit {

enum class Parity : std::uint8_t { none, even, odd };

/// The parities as a device file and messages call them.
inline constexpr std::array<std::pair<std::string_view, Parity>, 3> kParities = {
    {{"none", Parity::none}, {"even", Parity::even}, {"odd", Parity::odd}}};

/// A serial port and how it is set.
struct SerialLineSettings {
  /// Path, best below /dev/serial/by-id, which stays the same when the adapter is plugged in again.
  std::string device;
  int baud = serial_protocol_v1::kDefaultBaud;
  int data_bits = 8;  ///< 7 or 8
  Parity parity = Parity::none;
  int stop_bits = 1;        ///< 1 or 2
  bool low_latency = true;  ///< ask the adapter's driver to pass on bytes at once
};

}  // namespace bladefit
