#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace bladefit {

/// Tells of a disk that has stored nothing for a second while something waited, once a stall, and of its end.
class DiskWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// `folder`: of the session, for the words.
  explicit DiskWatch(std::string folder) : folder_(std::move(folder)) {}

  /// What is to be told now; empty = nothing. `taken`, `stored`: events so far; both rise only. Constant cost; called
  /// as often as something can have changed.
  [[nodiscard]] std::string look(std::uint64_t taken, std::uint64_t stored, Clock::time_point now);

 private:
  std::string folder_;
  std::uint64_t stored_ = 0;
  bool waiting_ = false, told_ = false;
  Clock::time_point since_{};  ///< when something began to wait, or something was stored last
};

}  // namespace bladefit
