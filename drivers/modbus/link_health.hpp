#pragma once
#include <chrono>
#include <utility>

#include "drivers/source/back_off.hpp"

namespace bladefit {

/// Whether the link to a device works: how often it was made, what it left unanswered, when to try again.
class LinkHealth {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kTimeoutsToLost = 3;  ///< missing replies in a row after which the link counts as lost

  LinkHealth(std::chrono::milliseconds first_pause, std::chrono::milliseconds longest_pause)
      : back_off_(first_pause, longest_pause) {}

  /// A session begins.
  void restart() {
    made_ = false;
    timeouts_ = 0;
  }

  /// The link is there. True where it was there before, in this session.
  bool make() {
    timeouts_ = 0;
    return std::exchange(made_, true);
  }

  /// The link broke, or could not be made.
  void fail(Clock::time_point now) { back_off_.failed(now); }

  /// The device at the other end is the right one.
  void recognise() { back_off_.succeeded(); }

  void reply_came() { timeouts_ = 0; }
  void reply_missing() { ++timeouts_; }

  [[nodiscard]] bool ever_made() const { return made_; }
  [[nodiscard]] bool seems_lost() const { return timeouts_ >= kTimeoutsToLost; }
  [[nodiscard]] int timeouts() const { return timeouts_; }
  [[nodiscard]] Clock::time_point retry_at() const { return back_off_.retry_at(); }

 private:
  BackOff back_off_;
  bool made_ = false;
  int timeouts_ = 0;  ///< in a row
};

}  // namespace bladefit
