#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "core/inspection/verdict.hpp"
#include "core/localizer.hpp"

namespace bladefit {

/// The words of result.json, verdicts.csv and the reports, in the order of the enumerations. A fit that is still
/// tracking when it ends has not converged.
inline constexpr std::array<std::string_view, 3> kKindWords = {"interior", "edge", "corner"};
inline constexpr std::array<std::string_view, 5> kStateWords = {"pending", "in", "out", "rejected", "undecided"};
inline constexpr std::array<std::string_view, 3> kActionWords = {"none", "cut", "weld"};
inline constexpr std::array<std::string_view, 3> kLeftOutWords = {"none", "window", "edge"};
inline constexpr std::array<std::string_view, 4> kFitWords = {"underdetermined", "not_converged", "converged",
                                                              "infeasible"};

template <typename Value, std::size_t count>
[[nodiscard]] constexpr std::string_view word_in(const std::array<std::string_view, count>& words, Value value) {
  return words.at(static_cast<std::size_t>(value));
}
[[nodiscard]] constexpr std::string_view word_of(FootKind kind) { return word_in(kKindWords, kind); }
[[nodiscard]] constexpr std::string_view word_of(PointState state) { return word_in(kStateWords, state); }
[[nodiscard]] constexpr std::string_view word_of(Action action) { return word_in(kActionWords, action); }
[[nodiscard]] constexpr std::string_view word_of(LeftOut reason) { return word_in(kLeftOutWords, reason); }
[[nodiscard]] constexpr std::string_view word_of(FitStatus status) { return word_in(kFitWords, status); }

/// The value whose word this is; nothing for another word.
template <typename Value, std::size_t count>
[[nodiscard]] std::optional<Value> value_of(const std::array<std::string_view, count>& words, std::string_view word) {
  for (std::size_t index = 0; index < count; ++index) {
    if (words[index] == word) return static_cast<Value>(index);
  }
  return std::nullopt;
}

/// What a person can do about a file of a session that cannot be read.
inline constexpr const char* kDamagedFileRemedy =
    "the file is damaged or foreign; run the session again with the same --session";
/// Characters of a wrong text that a message repeats.
inline constexpr std::size_t kQuotedCharacters = 40;

}  // namespace bladefit
