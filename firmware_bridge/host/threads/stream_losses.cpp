#include "firmware_bridge/host/threads/stream_losses.hpp"

namespace bladefit {

std::optional<SequenceRange> StreamLosses::take(const StreamEvent& event) {
  const std::uint64_t sequence = event.point.sequence;
  switch (event.kind) {
    case EventKind::point: {
      finished_ = false;
      const std::optional<SequenceRange> lost = advance(sequence);
      if (sequence >= next_) next_ = sequence + 1;
      return lost;
    }
    case EventKind::finished:
      finished_ = true;
      return advance(sequence + 1);
    case EventKind::lost:
      return advance(sequence + 1);
    case EventKind::reset:
      records_ = 0;
      unnumbered_ = finished_ = false;
      return std::nullopt;
    case EventKind::lost_unnumbered:
      unnumbered_ = true;
      return std::nullopt;
  }
  return std::nullopt;
}

/// The records before `next` that have not come are lost.
std::optional<SequenceRange> StreamLosses::advance(std::uint64_t next) {
  if (next <= next_) return std::nullopt;
  const SequenceRange lost{static_cast<std::uint32_t>(next_), static_cast<std::uint32_t>(next - 1)};
  records_ += static_cast<std::uint32_t>(next - next_);
  next_ = next;
  return lost;
}

}  // namespace bladefit
