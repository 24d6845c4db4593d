#pragma once
#include <array>
#include <cstdint>

namespace bladefit {

/// What the pose minimises. d: signed distances; w: 1 at the leading edge, the ratio of the tolerances on the rest.
enum class FitMode : std::uint8_t {
  least_squares = 0,  ///< sum d^2
  minimax = 1,        ///< max |d|
  range = 2,          ///< max d - min d (thesis 3-14)
  min_tolerance = 3,  ///< the smallest s with |d| <= s w (what thesis 5.3.2 finds by trial)
  constrained = 4     ///< sum d^2 subject to |d| <= tolerance (thesis 4-6, 4-7)
};

/// Points that prove an optimum of the maximum kind: at the pose their |d| / w is the value, and no motion lessens all
/// of them, since sum multiplier * sign * grad d = 0.
struct Certificate {
  std::array<std::uint32_t, 8> sequence{};
  std::array<double, 8> multiplier{};  ///< >= 0, sum of multiplier * w = 1
  std::array<int, 8> sign{};           ///< of d
  std::uint32_t count = 0;
};

}  // namespace bladefit
