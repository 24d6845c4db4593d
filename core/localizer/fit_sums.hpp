#pragma once
#include <array>
#include <cstdint>

#include "core/fit/quadratic_model.hpp"

namespace bladefit {

/// Sums over the points of one region, at the poses they were last projected at.
struct RegionSums {
  std::uint32_t count = 0;
  double square = 0;  ///< sum d^2 [mm^2]
  double worst = 0;   ///< signed [mm]
  std::uint32_t worst_sequence = 0;

  void add(double distance, std::uint32_t sequence) {
    ++count;
    square += distance * distance;
    const double magnitude = distance < 0.0 ? -distance : distance;
    if (worst_sequence != 0 && magnitude <= (worst < 0.0 ? -worst : worst)) return;
    worst = distance;
    worst_sequence = sequence;
  }
};

/// Everything that is summed over the points. Nothing is ever subtracted, so rounding does not build up: a sweep over
/// the stored points fills a new set, which then takes the place of the old one.
struct FitSums {
  QuadraticModel model;
  std::array<RegionSums, 2> regions;
};

}  // namespace bladefit
