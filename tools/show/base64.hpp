#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace bladefit {

/// The bytes as text (RFC 4648, section 4), padded with =.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

}  // namespace bladefit
