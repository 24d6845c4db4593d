#pragma once
#include <algorithm>
#include <chrono>

namespace bladefit {

/// Which request to a CMM has its turn. A poll period lies between two headers, and after a refused request of a kind
/// before the next one of that kind: a refused write must not keep from reading, nor the reverse.
class RequestSchedule {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RequestSchedule(Clock::duration poll_period) : poll_period_(poll_period) {}

  /// The link is new: everything may go from `ready` on.
  void restart(Clock::time_point ready) { next_header_ = next_read_ = next_write_ = ready; }

  [[nodiscard]] bool may_write(Clock::time_point now) const { return now >= next_write_ && !read_first_; }
  [[nodiscard]] bool may_read(Clock::time_point now) const { return now >= next_read_; }

  /// Decides between header and records where reading is allowed. On a slow line the header is always due: so records
  /// come after it where there are any.
  [[nodiscard]] bool take_header_turn(Clock::time_point now, bool records_wanted) {
    header_last_ = may_read(now) && now >= next_header_ && (!records_wanted || !header_last_);
    return header_last_;
  }

  /// A read goes out.
  void reading() { read_first_ = false; }

  /// A header came, or the device was given a command that its header will show.
  void delay_header(Clock::time_point now) { next_header_ = now + poll_period_; }

  /// The header is wanted at once.
  void hasten_header(Clock::time_point now) { next_header_ = std::min(next_header_, now); }

  /// The device has refused a write. It also waits for a read: on a slow line the time has passed at once.
  void write_refused(Clock::time_point now) {
    read_first_ = true;
    next_write_ = now + poll_period_;
  }

  void read_refused(Clock::time_point now) {
    read_first_ = false;
    next_read_ = now + poll_period_;
  }

  /// When something can be read again.
  [[nodiscard]] Clock::time_point next_turn() const { return std::max(next_header_, next_read_); }

 private:
  Clock::duration poll_period_;
  Clock::time_point next_header_{}, next_read_{}, next_write_{};
  bool read_first_ = false;
  bool header_last_ = false;  ///< the header has had its turn: now records have theirs
};

}  // namespace bladefit
