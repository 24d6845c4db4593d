#pragma once
#include <cstdint>
#include <vector>

#include "core/localizer.hpp"
#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/threads/session_outcome.hpp"
#include "firmware_bridge/host/threads/stream_event.hpp"
#include "firmware_bridge/host/threads/stream_losses.hpp"

namespace bladefit {

/// Takes the points of an ended session one by one, so that the host need not hold them.
class JudgedPoints {
 public:
  JudgedPoints() = default;
  virtual ~JudgedPoints() = default;
  JudgedPoints(const JudgedPoints&) = delete;
  JudgedPoints& operator=(const JudgedPoints&) = delete;

  /// A point as journalled, with its final verdict; rising sequence.
  virtual void add(const ProbePoint& point, const Verdict& verdict) = 0;
  /// The session was reset: the points so far are none of its result.
  virtual void clear() = 0;
};

/// What a session came to, beside its points.
struct SessionResult {
  SessionEnd end = SessionEnd::running;
  Failure error;  ///< set where `end` is failed; the rest is then of the points on disk
  FitReport report;
  std::vector<std::uint32_t> refused;  ///< journalled records that cannot be used; they are not among the points
  StreamLosses losses;
  std::vector<SequenceRange> lost;  ///< records that never came, rising
};

/// Takes the next event of the journal: a point, with its final verdict, goes to `points`, also where its place in the
/// fit was given away; what was lost or refused into `result`.
void add_event(const StreamEvent& event, const Localizer& localizer, SessionResult& result, JudgedPoints& points);

}  // namespace bladefit
