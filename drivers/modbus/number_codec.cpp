#include "drivers/modbus/number_codec.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace bladefit {
namespace {

bool swaps_bytes(ByteOrder order, std::uint16_t count) {
  return order == ByteOrder::low_first || (order == ByteOrder::low_first_in_long && count > 1);
}

/// The registers as one unsigned number, the most significant register first in memory of the device or last.
std::uint64_t joined(std::span<const std::uint16_t> words, std::uint16_t count, RegisterOrder order) {
  std::uint64_t bits = 0;
  for (std::uint16_t index = 0; index < count; ++index) {
    const std::uint16_t place =
        order.words == WordOrder::high_first ? index : static_cast<std::uint16_t>(count - 1 - index);
    bits = (bits << 16U) | (swaps_bytes(order.bytes, count) ? swapped_bytes(words[place]) : words[place]);
  }
  return bits;
}

}  // namespace

std::uint16_t swapped_bytes(std::uint16_t word) { return static_cast<std::uint16_t>((word << 8U) | (word >> 8U)); }

std::uint16_t register_count(NumberType type) {
  switch (type) {
    case NumberType::uint16:
    case NumberType::int16:
      return 1;
    case NumberType::uint32:
    case NumberType::int32:
    case NumberType::float32:
      return 2;
    case NumberType::float64:
      break;
  }
  return 4;
}

double decode_number(std::span<const std::uint16_t> words, NumberType type, RegisterOrder order) {
  const std::uint64_t bits = joined(words, register_count(type), order);
  switch (type) {
    case NumberType::uint16:
    case NumberType::uint32:
      return static_cast<double>(bits);
    case NumberType::int16:
      return static_cast<std::int16_t>(bits);
    case NumberType::int32:
      return static_cast<std::int32_t>(bits);
    case NumberType::float32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case NumberType::float64:
      break;
  }
  return std::bit_cast<double>(bits);
}

double decode_field(std::span<const std::uint16_t> block, std::uint16_t first, const NumberField& field,
                    RegisterOrder order) {
  return field.scale * decode_number(block.subspan(static_cast<std::size_t>(field.address - first)), field.type, order);
}

std::uint32_t decode_whole(std::span<const std::uint16_t> block, std::uint16_t first, const NumberField& field,
                           RegisterOrder order) {
  const double value = decode_field(block, first, field, order);
  const bool fits = value >= 0 && value <= std::numeric_limits<std::uint32_t>::max();
  return fits ? static_cast<std::uint32_t>(value) : 0;
}

void encode_whole(std::uint32_t value, NumberType type, RegisterOrder order, std::span<std::uint16_t> words) {
  const std::uint16_t count = register_count(type);
  std::uint64_t bits = value;
  if (type == NumberType::float32) bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  if (type == NumberType::float64) bits = std::bit_cast<std::uint64_t>(static_cast<double>(value));
  for (std::uint16_t index = 0; index < count; ++index) {
    const std::uint16_t place =
        order.words == WordOrder::high_first ? static_cast<std::uint16_t>(count - 1 - index) : index;
    const auto word = static_cast<std::uint16_t>(bits & 0xFFFFU);
    words[place] = swaps_bytes(order.bytes, count) ? swapped_bytes(word) : word;
    bits >>= 16U;
  }
}

}  // namespace bladefit
