#pragma once
#include <cstdint>
#include <optional>

#include "firmware_bridge/host/threads/stream_event.hpp"

namespace bladefit {

/// Sequence numbers, limits included.
struct SequenceRange {
  std::uint32_t first = 0, last = 0;
};

/// What a stream says of points that never came: a device numbers its records 1, 2, 3 ..., and a source leaves a number
/// out only where the record is not to be had. Allocates nothing.
class StreamLosses {
 public:
  /// Takes the next event. Returns the records that it shows to be lost, if any.
  std::optional<SequenceRange> take(const StreamEvent& event);

  /// The session's own end stands for that of a device that cannot tell one.
  void finish() { finished_ = true; }

  /// Records with a number, of the points not forgotten since.
  [[nodiscard]] std::uint32_t records() const { return records_; }
  /// Points were lost before they had a number.
  [[nodiscard]] bool unnumbered() const { return unnumbered_; }
  [[nodiscard]] bool any() const { return records_ > 0 || unnumbered_; }
  /// The device said that its program is finished, and no point has come since.
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  std::optional<SequenceRange> advance(std::uint64_t next);

  std::uint64_t next_ = 1;
  std::uint32_t records_ = 0;
  bool unnumbered_ = false, finished_ = false;
};

}  // namespace bladefit
