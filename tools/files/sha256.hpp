#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// SHA-256 (FIPS 180-4) of the bytes as 64 lower-case hexadecimal digits, as `sha256sum` writes it.
[[nodiscard]] std::string sha256_of(std::string_view bytes);

}  // namespace bladefit
