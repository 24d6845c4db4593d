#pragma once
#include <cstdint>
#include <map>
#include <optional>

#include "core/probe_point.hpp"
#include "drivers/source/point_queue.hpp"

namespace bladefit {

/// Puts the records of a device into their order: hands out each once, keeps those that came ahead of a missing one.
class RecordOrder {
 public:
  /// What became of a record.
  enum class Place : std::uint8_t {
    delivered,    ///< it was the next one
    ahead,        ///< others are missing before it
    ahead_again,  ///< the same, and it was here already
    old,          ///< it was delivered before
  };

  /// Records that nobody will ever deliver.
  struct Gap {
    std::uint32_t first = 0, last = 0;
    bool delivered = false;  ///< records behind the gap were delivered in its stead
  };

  /// Forgets everything; the next record wanted is after + 1.
  void restart(std::uint32_t after);

  Place take(const ProbePoint& point);

  /// The device said that its program ends with record `last`. False where records beyond it are here already.
  [[nodiscard]] bool end_at(std::uint32_t last);

  /// The device may go on after all.
  void forget_end() { end_.reset(); }

  /// Gives up the records that are missing; behind() must be true.
  Gap skip_missing();

  /// Sequence of the next record wanted; 2^32 where every number is used up.
  [[nodiscard]] std::uint64_t next() const { return next_; }

  /// Records are missing ahead of others that came, or ahead of the end that the device gave.
  [[nodiscard]] bool behind() const { return !ahead_.empty() || (end_ && *end_ >= next_); }

  /// Every record up to the end was delivered.
  [[nodiscard]] bool complete() const { return end_ && std::uint64_t{*end_} + 1 == next_; }

  [[nodiscard]] PointQueue& points() { return points_; }
  [[nodiscard]] const PointQueue& points() const { return points_; }

 private:
  void deliver(const ProbePoint& point);

  PointQueue points_;
  std::map<std::uint32_t, ProbePoint> ahead_;  ///< records behind a missing one
  std::uint64_t next_ = 1;
  std::optional<std::uint32_t> end_;  ///< last sequence of the program, as the device gave it
};

}  // namespace bladefit
