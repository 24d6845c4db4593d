#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// How a session ended, or that it goes on.
enum class SessionEnd : std::uint8_t { running, finished, idle, stopped, failed };

/// How the session ends, and what stopped it. Any thread but that of the fit may use it, since it locks.
class SessionOutcome {
 public:
  /// The first failure is kept; the session ends.
  void fail(const Failure& failure) {
    const std::lock_guard lock(mutex_);
    if (!failed_.load()) failure_ = failure;
    failed_.store(true);
  }

  [[nodiscard]] bool failed() const { return failed_.load(); }

  [[nodiscard]] Failure failure() {
    const std::lock_guard lock(mutex_);
    return failure_;
  }

  /// Acquisition only, before conclude(): whether the device's program is finished.
  void set_program_ended(bool ended) { program_ended_.store(ended); }
  [[nodiscard]] bool program_ended() const { return program_ended_.load(); }

  /// Acquisition only: no further point is taken.
  void conclude(SessionEnd end) { end_.store(failed() ? SessionEnd::failed : end); }

  [[nodiscard]] SessionEnd end() const { return end_.load(); }

 private:
  std::atomic<bool> failed_{false};
  std::atomic<bool> program_ended_{false};
  std::atomic<SessionEnd> end_{SessionEnd::running};
  std::mutex mutex_;
  Failure failure_;
};

}  // namespace bladefit
