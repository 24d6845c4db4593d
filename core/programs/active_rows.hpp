#pragma once
#include <array>
#include <cstdint>

namespace bladefit {

/// Rows that a program's solution rests on. At the optimum no motion lessens all of their |d| / w, since
/// sum multiplier * sign * grad d = 0.
struct ActiveRows {
  std::array<std::uint32_t, 8> index{};
  std::array<double, 8> multiplier{};  ///< >= 0, sum of multiplier * w = 1
  std::array<int, 8> sign{};           ///< of d
  std::uint32_t count = 0;
};

}  // namespace bladefit
