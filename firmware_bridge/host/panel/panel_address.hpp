#pragma once
#include <cstdint>
#include <string>

namespace bladefit {

/// Reads "HOST:PORT", "[IPV6]:PORT". False, and the arguments as before, when `text` is neither.
[[nodiscard]] bool parse_address(const std::string& text, std::string& host, std::uint16_t& port);

}  // namespace bladefit
