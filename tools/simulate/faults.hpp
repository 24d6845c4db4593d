#pragma once
#include <chrono>
#include <cstdint>
#include <string_view>

#include "tools/files/random_numbers.hpp"

namespace bladefit::simulate {

/// What may go wrong, as probabilities per record (serial) or per reply (Modbus).
struct FaultSettings {
  double drop = 0;
  double duplicate = 0;
  double corrupt = 0;
  double delay = 0;
  double disconnect = 0;
  std::chrono::nanoseconds delay_time = std::chrono::milliseconds(200);
  bool overflow = false;  ///< points go on when the ring is full, and the oldest are lost
  std::uint64_t seed = 1;
};

/// Reads a specification such as "drop=0.01,delay=0.05:200ms,disconnect=0.001,overflow,seed=7" on top of `defaults`.
/// Throws Failure (bad input) that names the item and the fix.
[[nodiscard]] FaultSettings parse_faults(std::string_view specification, const FaultSettings& defaults);

enum class Fault : std::uint8_t { none, disconnect, drop, delay, corrupt, duplicate };

/// Draws faults. The n-th draw depends on the settings and the seed only, never on time.
class FaultSource {
 public:
  explicit FaultSource(const FaultSettings& settings) : settings_(settings), random_(settings.seed) {}

  /// The fault of the next record or reply. Where several strike at once the most severe one wins.
  [[nodiscard]] Fault draw();

  /// Uniform in [0, bound), to choose the bit to change.
  [[nodiscard]] std::size_t choose(std::size_t bound) { return static_cast<std::size_t>(random_.next_below(bound)); }

  [[nodiscard]] std::chrono::nanoseconds delay_time() const { return settings_.delay_time; }

 private:
  FaultSettings settings_;
  RandomNumbers random_;
};

}  // namespace bladefit::simulate
