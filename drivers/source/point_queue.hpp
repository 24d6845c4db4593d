#pragma once
#include <algorithm>
#include <chrono>
#include <deque>
#include <span>

#include "core/probe_point.hpp"

namespace bladefit {

/// Received points that poll() has not handed out yet, in rising sequence order.
class PointQueue {
 public:
  void push(const ProbePoint& point) { points_.push_back(point); }

  [[nodiscard]] bool empty() const { return points_.empty(); }

  void clear() { points_.clear(); }

  /// Moves the oldest points to `points`. Returns how many.
  [[nodiscard]] std::size_t take(std::span<ProbePoint> points) {
    const std::size_t count = std::min(points.size(), points_.size());
    const auto end = points_.begin() + static_cast<std::ptrdiff_t>(count);
    std::copy(points_.begin(), end, points.begin());
    points_.erase(points_.begin(), end);
    return count;
  }

  /// Calls `step`, which waits until the time it is given and may push points, at least once and until points are
  /// there or `timeout` is over; then takes them. Points that are there already are not made to wait.
  template <typename Step>
  [[nodiscard]] std::size_t wait_and_take(std::span<ProbePoint> points, std::chrono::milliseconds timeout, Step step) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point until = empty() ? Clock::now() + timeout : Clock::now();
    do {
      step(until);
    } while (empty() && Clock::now() < until);
    return take(points);
  }

 private:
  std::deque<ProbePoint> points_;
};

}  // namespace bladefit
