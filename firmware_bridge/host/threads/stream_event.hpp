#pragma once
#include <cstdint>

#include "core/probe_point.hpp"

namespace bladefit {

enum class EventKind : std::uint8_t {
  point = 1,
  finished = 2,         ///< the device said that its program is finished
  reset = 3,            ///< the operator asked to forget all points so far
  lost_unnumbered = 4,  ///< points were lost before they had a number
  lost = 5,             ///< every record that has not come is given up, up to the sequence of `point`
};

/// One element of the stream that a session consists of. The order of the events, and nothing else, decides about the
/// result; so it is they that the journal keeps.
struct StreamEvent {
  EventKind kind = EventKind::point;
  /// Of kind point. Of kinds finished and lost its sequence alone: of finished that of the device's last record; 0 =
  /// not known.
  ProbePoint point;
};

}  // namespace bladefit
