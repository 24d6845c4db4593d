#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace bladefit {

/// Why a blade is not decided, or what a reader of its verdict must know.
enum class ReasonCode : std::uint8_t {
  not_converged = 0,
  underdetermined,
  unproven,
  points_lost,
  points_refused,
  zone_not_probed,
  pending,
  undecided,
  unfinished,
  wrong_units,
  mirrored,
  ambiguous,
  far_start
};

/// The words of result.json, in the order of the values.
inline constexpr std::array<std::string_view, 13> kReasonWords = {
    "not_converged", "underdetermined", "unproven",    "points_lost", "points_refused", "zone_not_probed", "pending",
    "undecided",     "unfinished",      "wrong_units", "mirrored",    "ambiguous",      "far_start"};

[[nodiscard]] constexpr std::string_view word_of(ReasonCode code) {
  return kReasonWords.at(static_cast<std::size_t>(code));
}

/// One sentence: what happened and what to do.
struct VerdictReason {
  ReasonCode code = ReasonCode::not_converged;
  std::string text;
};

}  // namespace bladefit
