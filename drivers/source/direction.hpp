#pragma once
#include <array>
#include <cmath>

namespace bladefit {

inline constexpr double kUnitVectorTolerance = 1e-3;  ///< a length that differs from 1 by more is no unit vector

/// Length of a vector.
[[nodiscard]] inline double length_of(const std::array<double, 3>& vector) {
  return std::hypot(vector[0], vector[1], vector[2]);
}

/// Makes a direction exactly as long as 1. All 0 (unknown) stays. False: it is neither 0 nor a unit vector.
[[nodiscard]] inline bool normalise_direction(std::array<double, 3>& direction) {
  if (direction == std::array<double, 3>{}) return true;
  const double length = length_of(direction);
  if (!(std::abs(length - 1) <= kUnitVectorTolerance)) return false;
  for (double& component : direction) component /= length;
  return true;
}

}  // namespace bladefit
