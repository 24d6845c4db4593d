#pragma once
#include <string>
#include <string_view>

#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Reads "//HOST:PORT", what stands behind the `scheme` of a URI. HOST is a name, an IPv4 address or an IPv6 address in
/// brackets. bad_input with a phrase that names the part and the fix; then `tcp` is as before.
[[nodiscard]] Failure parse_tcp_place(std::string_view place, std::string_view scheme, TcpSettings& tcp);

/// The way back.
[[nodiscard]] std::string tcp_place(const TcpSettings& tcp);

}  // namespace bladefit
