#include "drivers/modbus/tcp_place.hpp"

#include <fmt/format.h>

#include <optional>

#include "drivers/text/text_number.hpp"

namespace bladefit {

Failure parse_tcp_place(std::string_view place, std::string_view scheme, TcpSettings& tcp) {
  const auto missing = [scheme](std::string_view part) {
    return bad_input(fmt::format("{} is missing; write {}://HOST:PORT", part, scheme));
  };
  if (!place.starts_with("//")) return missing("'//'");
  place.remove_prefix(2);
  const std::size_t colon = place.rfind(':');
  if (colon == std::string_view::npos || place.ends_with(']')) {
    return missing("the port");
  }
  std::string_view host = place.substr(0, colon);
  const std::optional<std::uint16_t> port = parse_whole<std::uint16_t>(place.substr(colon + 1));
  if (!port || *port == 0) return bad_input("the port is not a whole number 1..65535");
  const bool bracketed = host.starts_with('[') && host.ends_with(']');
  if (bracketed) host = host.substr(1, host.size() - 2);
  if (host.empty()) return missing("the host");
  if (!bracketed && host.find(':') != std::string_view::npos) {
    return bad_input("the host has a ':'; put an IPv6 address into brackets");
  }
  if (host.find_first_of("/@ ") != std::string_view::npos) {
    return bad_input("the host has a character that no host has");
  }
  tcp = {std::string(host), *port};
  return {};
}

std::string tcp_place(const TcpSettings& tcp) {
  const bool bare_ipv6 = tcp.host.find(':') != std::string::npos;
  return bare_ipv6 ? fmt::format("//[{}]:{}", tcp.host, tcp.port) : fmt::format("//{}:{}", tcp.host, tcp.port);
}

}  // namespace bladefit
