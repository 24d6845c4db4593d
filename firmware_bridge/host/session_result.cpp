#include "firmware_bridge/host/session_result.hpp"

namespace bladefit {

namespace {

/// Ranges that follow each other without a gap are one.
void add_range(const SequenceRange& range, std::vector<SequenceRange>& ranges) {
  if (!ranges.empty() && ranges.back().last + 1 == range.first) {
    ranges.back().last = range.last;
  } else {
    ranges.push_back(range);
  }
}

}  // namespace

void add_event(const StreamEvent& event, const Localizer& localizer, SessionResult& result, JudgedPoints& points) {
  const std::optional<SequenceRange> lost = result.losses.take(event);
  if (lost) add_range(*lost, result.lost);
  if (event.kind == EventKind::reset) {
    points.clear();
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
  points.add(event.point, verdict);
}

}  // namespace bladefit
