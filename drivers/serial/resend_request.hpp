#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>

#include "drivers/serial/serial_settings.hpp"

namespace bladefit {

/// When a device is to be asked for a missing record, and when that was asked in vain. A damaged line is a reason to
/// ask, but no haste: it may have been a resent one that is not needed, so it is seen first whether the next record
/// follows.
class ResendRequest {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ResendRequest(const SerialSettings& settings) : settings_(settings) {}

  void restart() {
    doubtful_ = false;
    record_ = 0;
    times_ = 0;
  }

  /// A damaged line came.
  void doubt(Clock::time_point now) {
    doubtful_ = true;
    doubted_at_ = now;
  }

  /// Nothing was lost by the damaged line.
  void dispel_doubt() { doubtful_ = false; }

  [[nodiscard]] bool doubtful() const { return doubtful_; }

  /// When record `next` may be asked for.
  [[nodiscard]] Clock::time_point due(std::uint32_t next) const {
    return asked_at_ + (record_ == next ? settings_.resend_interval : settings_.resend_pause);
  }

  /// The same where nothing but a damaged line suggests that it is missing.
  [[nodiscard]] Clock::time_point due_after_doubt(std::uint32_t next) const {
    return std::max(due(next), doubted_at_ + settings_.resend_pause);
  }

  /// The device was asked for record `next` often enough.
  [[nodiscard]] bool in_vain(std::uint32_t next, Clock::time_point now) const {
    return record_ == next && times_ >= settings_.resend_tries && now >= asked_at_ + settings_.resend_interval;
  }

  /// Record `next` is asked for now.
  void ask(std::uint32_t next, Clock::time_point now) {
    times_ = record_ == next ? times_ + 1 : 1;
    record_ = next;
    asked_at_ = now;
    doubtful_ = false;
  }

  /// How often the last record was asked for.
  [[nodiscard]] int times() const { return times_; }

 private:
  const SerialSettings& settings_;
  bool doubtful_ = false;           ///< a damaged line came since the last good record
  std::uint32_t record_ = 0;        ///< that was asked for last; 0 = none
  int times_ = 0;                   ///< how often it was asked for
  Clock::time_point asked_at_{};    ///< when last
  Clock::time_point doubted_at_{};  ///< time of the damaged line
};

}  // namespace bladefit
