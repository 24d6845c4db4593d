#pragma once
#include <chrono>
#include <cstdint>

namespace bladefit {

/// The host's monotonic clock [us].
[[nodiscard]] inline std::int64_t host_time_us() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

}  // namespace bladefit
