#pragma once
#include <cstdint>

namespace bladefit::simulate {

/// SplitMix64 (Steele, Lea and Flood, 2014): the same numbers from the same seed on every machine and library.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
    return mixed ^ (mixed >> 31U);
  }

  /// Uniform in [0, 1).
  [[nodiscard]] double next_fraction() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

  /// Uniform in [0, bound); bound must not be 0. The bias of the remainder is below bound / 2^64.
  [[nodiscard]] std::uint64_t next_below(std::uint64_t bound) { return next() % bound; }

 private:
  std::uint64_t state_;
};

}  // namespace bladefit::simulate
