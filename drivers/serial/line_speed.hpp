#pragma once
#include <termios.h>

#include <algorithm>
#include <array>
#include <optional>

namespace bladefit {

struct LineSpeed {
  int baud;
  speed_t code;
};

/// Every rate that a port can be set to without falling back to another.
inline constexpr std::array kLineSpeeds = {
    LineSpeed{1200, B1200},       LineSpeed{2400, B2400},       LineSpeed{4800, B4800},
    LineSpeed{9600, B9600},       LineSpeed{19200, B19200},     LineSpeed{38400, B38400},
    LineSpeed{57600, B57600},     LineSpeed{115200, B115200},   LineSpeed{230400, B230400},
    LineSpeed{460800, B460800},   LineSpeed{500000, B500000},   LineSpeed{576000, B576000},
    LineSpeed{921600, B921600},   LineSpeed{1000000, B1000000}, LineSpeed{1152000, B1152000},
    LineSpeed{1500000, B1500000}, LineSpeed{2000000, B2000000}, LineSpeed{2500000, B2500000},
    LineSpeed{3000000, B3000000}, LineSpeed{3500000, B3500000}, LineSpeed{4000000, B4000000}};

/// The system's code of a rate; nothing where it is no standard rate.
[[nodiscard]] inline std::optional<speed_t> speed_code(int baud) {
  const auto* const found = std::find_if(kLineSpeeds.begin(), kLineSpeeds.end(),
                                         [baud](const LineSpeed& speed) { return speed.baud == baud; });
  if (found == kLineSpeeds.end()) return std::nullopt;
  return found->code;
}

}  // namespace bladefit
