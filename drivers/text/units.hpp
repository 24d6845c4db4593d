#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace bladefit {

/// Everything inside is in mm; a length in another unit is turned where it comes in, and back where it is written.
inline constexpr double kMmPerInch = 25.4;

/// A unit in which lengths are given and written.
enum class Unit : std::uint8_t { mm, inch, cm, metre };

/// Of each, in the order of the enumeration: how options, files and results name it, and its size [mm].
inline constexpr std::array<std::string_view, 4> kUnitWords = {"mm", "in", "cm", "m"};
inline constexpr std::array<double, 4> kMmPerUnit = {1, kMmPerInch, 10, 1000};

constexpr std::string_view word_of(Unit unit) { return kUnitWords[static_cast<std::size_t>(unit)]; }

constexpr double mm_per_unit(Unit unit) { return kMmPerUnit[static_cast<std::size_t>(unit)]; }

/// The unit that a text in lower case names in one of the usual spellings: mm, millimetres, in, inch, " ...
[[nodiscard]] std::optional<Unit> parse_unit(std::string_view text);

}  // namespace bladefit
