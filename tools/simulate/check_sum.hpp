#pragma once
#include <cstdint>
#include <string_view>

namespace bladefit::simulate {

/// CRC-16 of `bytes`, bit by bit: reflected, no final exclusive or. The machine's own, so that a wrong one in the
/// drivers cannot agree with itself.
[[nodiscard]] constexpr std::uint16_t check_sum(std::string_view bytes, std::uint16_t initial,
                                                std::uint16_t polynomial) {
  unsigned sum = initial;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) != 0 ? (sum >> 1U) ^ polynomial : sum >> 1U;
  }
  return static_cast<std::uint16_t>(sum);
}

}  // namespace bladefit::simulate
