#pragma once
#include <chrono>

namespace bladefit {

/// Wakes one waiting thread from others. A wake-up that comes while nobody waits is kept for the next wait.
class Wakeup {
 public:
  /// Throws std::runtime_error when the system has no file descriptor left.
  Wakeup();
  ~Wakeup();
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;

  /// Any thread; never waits.
  void signal() const;

  /// The waiting thread only. Returns at a wake-up or after `timeout`.
  void wait(std::chrono::milliseconds timeout) const;

  /// The waiting thread only: forgets wake-ups that have come. For those who wait on descriptor() themselves.
  void clear() const;

  /// Becomes readable at a wake-up.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace bladefit
