#pragma once
#include <cstdint>
#include <span>

#include "drivers/modbus/modbus_settings.hpp"

namespace bladefit {

/// Registers that a number takes.
[[nodiscard]] std::uint16_t register_count(NumberType type);

/// A register with its bytes swapped.
[[nodiscard]] std::uint16_t swapped_bytes(std::uint16_t word);

/// The raw number in `words`, of which register_count(type) count. Exact for every type.
[[nodiscard]] double decode_number(std::span<const std::uint16_t> words, NumberType type, RegisterOrder order);

/// scale * raw of a field within `block`, whose first register has the address `first`. The field must lie in the
/// block.
[[nodiscard]] double decode_field(std::span<const std::uint16_t> block, std::uint16_t first, const NumberField& field,
                                  RegisterOrder order);

/// Whole part of decode_field() for sequences, identities and bits; what no uint32 can hold becomes 0.
[[nodiscard]] std::uint32_t decode_whole(std::span<const std::uint16_t> block, std::uint16_t first,
                                         const NumberField& field, RegisterOrder order);

/// Writes a whole number that the type can hold to `words`, of which register_count(type) are used.
void encode_whole(std::uint32_t value, NumberType type, RegisterOrder order, std::span<std::uint16_t> words);

}  // namespace bladefit
