#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace bladefit {

/// CRC-16/MODBUS (reflected polynomial 0xA001, initial value 0xFFFF, no final exclusive or), byte by byte.
class Crc16 {
 public:
  constexpr void add(std::uint8_t byte) {
    value_ = static_cast<std::uint16_t>(value_ ^ byte);
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (value_ & 1U) != 0;
      value_ = static_cast<std::uint16_t>(value_ >> 1U);
      if (carry) value_ = static_cast<std::uint16_t>(value_ ^ 0xA001U);
    }
  }

  [[nodiscard]] constexpr std::uint16_t value() const { return value_; }

 private:
  std::uint16_t value_ = 0xFFFF;
};

/// CRC-16/MODBUS of characters.
[[nodiscard]] constexpr std::uint16_t crc16(std::string_view text) {
  Crc16 crc;
  for (const char character : text) crc.add(static_cast<std::uint8_t>(character));
  return crc.value();
}

/// CRC-16/MODBUS of registers, the high byte of each first.
[[nodiscard]] constexpr std::uint16_t crc16(std::span<const std::uint16_t> registers) {
  Crc16 crc;
  for (const std::uint16_t word : registers) {
    crc.add(static_cast<std::uint8_t>(word >> 8U));
    crc.add(static_cast<std::uint8_t>(word & 0xFFU));
  }
  return crc.value();
}

}  // namespace bladefit
