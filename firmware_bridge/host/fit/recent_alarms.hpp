#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "core/inspection/verdict.hpp"

namespace bladefit {

/// The leading-edge points found out of tolerance last. Somebody is about to act on these, so their distances are
/// reported again with the figures of the fit: a revision comes out only when the state or the action of a point
/// changes, while the distance goes on with the pose. No call allocates.
class RecentAlarms {
 public:
  /// A limit on what the report of a burst costs; older alarms keep the distance of their last revision.
  static constexpr std::size_t kMost = 16;

  void note(const Verdict& verdict) {
    const bool alarm = verdict.state == PointState::out && verdict.region == Region::leading_edge;
    if (!alarm || std::ranges::find(sequences_, verdict.sequence) != sequences_.end()) return;
    sequences_[next_] = verdict.sequence;
    next_ = (next_ + 1) % kMost;
  }

  void clear() { sequences_.fill(0); }

  /// Their sequence numbers; 0 = none.
  [[nodiscard]] std::span<const std::uint32_t, kMost> sequences() const { return sequences_; }

 private:
  std::array<std::uint32_t, kMost> sequences_{};
  std::size_t next_ = 0;
};

}  // namespace bladefit
