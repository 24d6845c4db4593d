#pragma once
#include <string>
#include <string_view>

#include "drivers/serial/serial_message.hpp"

namespace bladefit {

/// A message as it stands between its first character and its line end: content, mark and check sum.
inline std::string body(std::string_view content) {
  const std::string line = encode_line(content);
  return line.substr(1, line.size() - 3);
}

}  // namespace bladefit
