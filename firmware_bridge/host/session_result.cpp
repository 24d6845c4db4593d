#include "firmware_bridge/host/session_result.hpp"

namespace bladefit {

void add_points(std::span<const StreamEvent> events, const Localizer& localizer, const Tally& tally,
                SessionResult& result) {
  for (const StreamEvent& event : events) {
    const std::optional<SequenceRange> lost = result.losses.take(event);
    if (lost) result.lost.push_back(*lost);
    if (event.kind == EventKind::reset) {
      result.points.clear();
      result.verdicts.clear();
      result.refused.clear();
      result.lost.clear();
    }
    const Verdict* const last = tally.find(event.point.sequence);
    if (event.kind != EventKind::point || last == nullptr) continue;
    Verdict verdict = *last;
    [[maybe_unused]] const Status status = localizer.verdict_of(event.point.sequence, verdict);
    if (!has_foot(verdict)) {
      result.refused.push_back(event.point.sequence);
      continue;
    }
    result.points.push_back(event.point);
    result.verdicts.push_back(verdict);
  }
}

}  // namespace bladefit
