#pragma once
#include <algorithm>
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

 private:
  std::deque<ProbePoint> points_;
};

}  // namespace bladefit
