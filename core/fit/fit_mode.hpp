#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace bladefit {

/// What the pose minimises. d: signed distances; w: 1 at the leading edge, the ratio of the tolerances on the rest;
/// with zones the tolerance of each on the side of d.
enum class FitMode : std::uint8_t {
  least_squares = 0,  ///< sum d^2
  minimax = 1,        ///< max |d|
  range = 2,          ///< max d - min d (thesis 3-14)
  min_tolerance = 3,  ///< the smallest s with |d| <= s w (what thesis 5.3.2 finds by trial)
  constrained = 4     ///< sum d^2 subject to |d| <= tolerance (thesis 4-6, 4-7)
};

/// The words of the modes on the command line, in files and in results, in the order of their values.
inline constexpr std::array<std::string_view, 5> kFitModeWords = {"least_squares", "minimax", "range", "min_tolerance",
                                                                  "constrained"};

/// What each mode minimises, for whoever sets one.
inline constexpr std::string_view kFitModeHelp =
    "what the fit minimises: least_squares (default): the sum of squared distances; minimax: the largest "
    "distance; range: the largest less the smallest signed distance; min_tolerance: the leading-edge "
    "tolerance that can just be met, with ratio times it on the rest, or with zones the smallest multiple of all "
    "their tolerances; constrained: the sum of squares with every distance within its tolerance, with zones from "
    "-minus to plus of its own";

constexpr std::string_view word_of(FitMode mode) { return kFitModeWords[static_cast<std::size_t>(mode)]; }

/// Points that prove an optimum of the maximum kind: at the pose their |d| / w is the value, and no motion lessens all
/// of them, since sum multiplier * sign * grad d = 0.
struct Certificate {
  std::array<std::uint32_t, 8> sequence{};
  std::array<double, 8> multiplier{};  ///< >= 0, sum of multiplier * w = 1, where w is 1 at the tightest tolerance
  std::array<int, 8> sign{};           ///< of d
  std::uint32_t count = 0;
};

}  // namespace bladefit
