#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "core/probe_point.hpp"

namespace bladefit {

/// One line from the device.
struct SerialMessage {
  enum class Kind : std::uint8_t { damaged, run, point, finished, host };

  Kind kind = Kind::damaged;
  std::uint32_t number = 0;  ///< run id of `run`, sequence of `point` and `finished`
  ProbePoint point;          ///< of `point`, without a time
  std::string damage;        ///< of `damaged`: what is wrong, in words
};

/// Decodes a line as the framer gives it: tag, fields and check sum. A line of the host's own (an echo) is `host`.
[[nodiscard]] SerialMessage parse_message(std::string_view line);

/// A line to send: `$`, content, `*`, check sum, line end.
[[nodiscard]] std::string encode_line(std::string_view content);

/// The same for a tag with a sequence.
[[nodiscard]] std::string encode_line(std::string_view tag, std::uint32_t sequence);

}  // namespace bladefit
