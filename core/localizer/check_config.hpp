#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/localizer.hpp"

namespace bladefit {

/// Limits of a configuration, both included.
inline constexpr std::uint32_t kLeastCapacity = 6, kMostCapacity = 16777216;
inline constexpr std::uint32_t kLeastRefresh = 2, kMostRefresh = 64;
inline constexpr std::uint32_t kMostFurtherStarts = 12;

/// Stands for the number of patches of a design that is not known yet.
inline constexpr std::size_t kAnyPatches = std::numeric_limits<std::size_t>::max();

/// Why no fit can be made with a configuration.
struct ConfigFault {
  const char* field = nullptr;  ///< its name, as for_each_field() has it; null = nothing is wrong
  const char* reason = "";      ///< what it must be: "must be above 0"
  Status status = Status::ok;   ///< not_finite or out_of_range
  [[nodiscard]] explicit operator bool() const { return field != nullptr; }
};

/// The first fault of a configuration for a design of so many patches; the only place with the limits of its fields.
/// A choice with a value that is not one of its enumeration is left to whoever makes it from a number.
/// Order: sizes and sets (out_of_range), then numbers that are not finite (not_finite), then ranges and what fields
/// ask of each other (out_of_range). Cost: linear in the number of boxes.
[[nodiscard]] ConfigFault check_config(const LocalizerConfig& config, std::size_t patches);

}  // namespace bladefit
