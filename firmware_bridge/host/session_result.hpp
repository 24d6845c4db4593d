#pragma once
#include <cstdint>
#include <vector>

#include "core/localizer.hpp"
#include "drivers/source/failure.hpp"
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

/// Puts the next event of the journal into `result`: a point with its final verdict, also where its place in the fit
/// was given away, or what was lost.
void add_event(const StreamEvent& event, const Localizer& localizer, SessionResult& result);

}  // namespace bladefit
