#pragma once
#include <array>
#include <cstdint>

namespace bladefit {

/// Durations in bins of fixed number, each about 9 % wide, from 10 ns to 10 s. No call allocates.
class LatencyHistogram {
 public:
  void add(std::int64_t nanoseconds);

  /// Upper limit [us] of the bin below which `fraction` of the durations lie; 0 when there are none.
  [[nodiscard]] double quantile_us(double fraction) const;

 private:
  static constexpr int kBinsPerOctave = 8;
  static constexpr double kLeast_ns = 10;
  static constexpr std::size_t kBins = 240;
  std::array<std::uint64_t, kBins> counts_{};
  std::uint64_t total_ = 0;
};

}  // namespace bladefit
