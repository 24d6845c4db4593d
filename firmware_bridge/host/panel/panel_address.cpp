#include "firmware_bridge/host/panel/panel_address.hpp"

#include <charconv>

namespace bladefit {

bool parse_address(const std::string& text, std::string& host, std::uint16_t& port) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return false;
  std::string name = text.substr(0, colon);
  const bool bracketed = name.size() > 2 && name.front() == '[' && name.back() == ']';
  if (bracketed) name = name.substr(1, name.size() - 2);
  if (!bracketed && name.find(':') != std::string::npos) return false;
  const char* end = text.data() + text.size();
  std::uint16_t number = 0;
  const auto [stopped, error] = std::from_chars(text.data() + colon + 1, end, number);
  if (error != std::errc() || stopped != end) return false;
  host = name;
  port = number;
  return true;
}

}  // namespace bladefit
