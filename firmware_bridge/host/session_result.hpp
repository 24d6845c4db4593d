#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/localizer.hpp"
#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/panel/tally.hpp"
#include "firmware_bridge/host/threads/session_outcome.hpp"
#include "firmware_bridge/host/threads/stream_event.hpp"
#include "firmware_bridge/host/threads/stream_losses.hpp"

namespace bladefit {

/// What a session came to.
struct SessionResult {
  SessionEnd end = SessionEnd::running;
  Failure error;  ///< set where `end` is failed; the rest is then of the points on disk
  FitReport report;
  std::vector<ProbePoint> points;      ///< as journalled, rising sequence
  std::vector<Verdict> verdicts;       ///< final ones; verdicts[i] is that of points[i]
  std::vector<std::uint32_t> refused;  ///< journalled records that cannot be used; they are not among `points`
  StreamLosses losses;
  std::vector<SequenceRange> lost;  ///< records that never came, rising
};

/// Puts the points of `events`, what the journal holds, into `result`, each with its final verdict: that of the fit, or
/// the last one that came out for a point whose place in the fit was given away. So too what was lost.
void add_points(std::span<const StreamEvent> events, const Localizer& localizer, const Tally& tally,
                SessionResult& result);

}  // namespace bladefit
