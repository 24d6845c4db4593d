#include "firmware_bridge/host/session_result.hpp"

namespace bladefit {

void add_event(const StreamEvent& event, const Localizer& localizer, SessionResult& result) {
  const std::optional<SequenceRange> lost = result.losses.take(event);
  if (lost) result.lost.push_back(*lost);
  if (event.kind == EventKind::reset) {
    result.points.clear();
    result.verdicts.clear();
    result.refused.clear();
    result.lost.clear();
  }
  if (event.kind != EventKind::point) return;
  Verdict verdict;
  Status status = localizer.verdict_of(event.point.sequence, verdict);
  if (status == Status::not_found) status = localizer.judge_aside(event.point, verdict);
  if (!succeeded(status)) {
    result.refused.push_back(event.point.sequence);
    return;
  }
  result.points.push_back(event.point);
  result.verdicts.push_back(verdict);
}

}  // namespace bladefit
