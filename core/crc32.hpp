#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace bladefit {

/// CRC-32 (IEEE 802.3, as in zlib) of `bytes`. `seed` is the CRC of what came before; 0 at the start.
/// Cost: some 0.5 ns a byte.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t seed = 0);

}  // namespace bladefit
