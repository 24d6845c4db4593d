#include "drivers/serial/record_order.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kMostAhead = 4096;  ///< records kept behind a missing one

}  // namespace

void RecordOrder::restart(std::uint32_t after) {
  points_.clear();
  ahead_.clear();
  next_ = std::uint64_t{after} + 1;
  end_.reset();
}

RecordOrder::Place RecordOrder::take(const ProbePoint& point) {
  if (point.sequence < next_) return Place::old;
  if (point.sequence > next_) {
    const bool again = ahead_.size() < kMostAhead && !ahead_.emplace(point.sequence, point).second;
    return again ? Place::ahead_again : Place::ahead;
  }
  deliver(point);
  return Place::delivered;
}

/// Hands out a record and those kept behind it. A record beyond the end given before means that probing goes on.
void RecordOrder::deliver(const ProbePoint& point) {
  points_.push(point);
  next_ = std::uint64_t{point.sequence} + 1;
  while (!ahead_.empty() && ahead_.begin()->first <= next_) {
    if (ahead_.begin()->first == next_) {
      points_.push(ahead_.begin()->second);
      ++next_;
    }
    ahead_.erase(ahead_.begin());
  }
  if (end_ && next_ > std::uint64_t{*end_} + 1) end_.reset();
}

bool RecordOrder::end_at(std::uint32_t last) {
  if (std::uint64_t{last} + 1 < next_) return false;
  end_ = last;
  return true;
}

RecordOrder::Gap RecordOrder::skip_missing() {
  const auto first = static_cast<std::uint32_t>(next_);
  if (ahead_.empty()) {
    next_ = std::uint64_t{*end_} + 1;
    return {first, *end_, false};
  }
  const ProbePoint point = ahead_.begin()->second;
  deliver(point);
  return {first, point.sequence - 1, true};
}

}  // namespace bladefit
