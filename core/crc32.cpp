#include "core/crc32.hpp"

#include <array>

namespace bladefit {
namespace {

/// Bytes that are taken at a time.
constexpr std::size_t kSlice = 8;
using Table = std::array<std::array<std::uint32_t, 256>, kSlice>;

/// table[k][b]: what a byte b leaves that k bytes of 0 follow.
constexpr Table make_table() {
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
    table[0][byte] = remainder;
  }
  for (std::size_t k = 1; k < kSlice; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = table[k - 1][byte];
      table[k][byte] = (before >> 8U) ^ table[0][before & 0xFFU];
    }
  }
  return table;
}

constexpr Table kTable = make_table();

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t seed) {
  std::uint32_t remainder = ~seed;
  for (; bytes.size() >= kSlice; bytes = bytes.subspan(kSlice)) {
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < kSlice; ++k) {
      auto byte = std::to_integer<std::uint32_t>(bytes[k]);
      if (k < 4) byte ^= (remainder >> (8U * k)) & 0xFFU;
      next ^= kTable[kSlice - 1 - k][byte];
    }
    remainder = next;
  }
  for (const std::byte byte : bytes) {
    remainder = (remainder >> 8U) ^ kTable[0][(remainder ^ std::to_integer<std::uint32_t>(byte)) & 0xFFU];
  }
  return ~remainder;
}

}  // namespace bladefit
