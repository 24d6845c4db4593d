#pragma once
#include <chrono>
#include <cstdint>

namespace bladefit {

enum class Readiness : std::uint8_t { timeout, ready, hang_up };

/// Waits until `descriptor` can be read (or written, where `for_writing`), or the moment `until` is reached, or a
/// signal arrives, which counts as timeout. Bytes that came before a hang-up are `ready` first.
[[nodiscard]] Readiness wait_ready(int descriptor, bool for_writing, std::chrono::steady_clock::time_point until);

}  // namespace bladefit
