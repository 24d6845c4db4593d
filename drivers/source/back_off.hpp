#pragma once
#include <algorithm>
#include <chrono>

namespace bladefit {

/// When to try again: pauses that double from `first` up to `longest`.
class BackOff {
 public:
  using Clock = std::chrono::steady_clock;

  BackOff(std::chrono::milliseconds first, std::chrono::milliseconds longest) : first_(first), longest_(longest) {}

  /// A try failed, or the link broke, at `now`.
  void failed(Clock::time_point now) {
    pause_ = pause_.count() == 0 ? first_ : std::min(2 * pause_, longest_);
    retry_at_ = now + pause_;
  }

  /// The link works: the next pause is the first one again.
  void succeeded() { pause_ = std::chrono::milliseconds{0}; }

  [[nodiscard]] Clock::time_point retry_at() const { return retry_at_; }

 private:
  std::chrono::milliseconds first_, longest_;
  std::chrono::milliseconds pause_{0};
  Clock::time_point retry_at_{};
};

}  // namespace bladefit
