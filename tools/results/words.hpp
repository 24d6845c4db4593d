#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "core/inspection/verdict.hpp"

namespace bladefit {

/// The words of result.json and verdicts.csv, in the order of the enumerations.
inline constexpr std::array<std::string_view, 3> kKindWords = {"interior", "edge", "corner"};
inline constexpr std::array<std::string_view, 2> kRegionWords = {"rest", "leading_edge"};
inline constexpr std::array<std::string_view, 4> kStateWords = {"pending", "in", "out", "rejected"};
inline constexpr std::array<std::string_view, 3> kActionWords = {"none", "cut", "weld"};

[[nodiscard]] constexpr std::string_view word_of(FootKind kind) {
  return kKindWords.at(static_cast<std::size_t>(kind));
}
[[nodiscard]] constexpr std::string_view word_of(Region region) {
  return kRegionWords.at(static_cast<std::size_t>(region));
}
[[nodiscard]] constexpr std::string_view word_of(PointState state) {
  return kStateWords.at(static_cast<std::size_t>(state));
}
[[nodiscard]] constexpr std::string_view word_of(Action action) {
  return kActionWords.at(static_cast<std::size_t>(action));
}

/// The value whose word this is; nothing for another word.
template <typename Value, std::size_t count>
[[nodiscard]] std::optional<Value> value_of(const std::array<std::string_view, count>& words, std::string_view word) {
  for (std::size_t index = 0; index < count; ++index) {
    if (words[index] == word) return static_cast<Value>(index);
  }
  return std::nullopt;
}

}  // namespace bladefit
