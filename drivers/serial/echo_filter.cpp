#include "drivers/serial/echo_filter.hpp"

#include <algorithm>

#include "drivers/serial/protocol_v1.hpp"

namespace bladefit {

void EchoFilter::sent(std::string_view lines) {
  constexpr std::string_view kEnd = serial_protocol_v1::kEnd;
  for (std::size_t end = lines.find(kEnd); end != std::string_view::npos; end = lines.find(kEnd)) {
    expected_.emplace_back(lines.substr(1, end - 1));
    lines.remove_prefix(end + kEnd.size());
  }
}

bool EchoFilter::takes(std::string_view line) {
  const auto echo = std::find(expected_.begin(), expected_.end(), line);
  if (echo == expected_.end()) return false;
  expected_.erase(expected_.begin(), echo + 1);
  return true;
}

}  // namespace bladefit
