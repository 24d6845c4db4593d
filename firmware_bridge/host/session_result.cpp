#include "firmware_bridge/host/session_result.hpp"

namespace bladefit {
namespace {

/// False for a record that the localizer could not use, such as one with a number that is not finite.
bool has_foot(const Verdict& verdict) { return !verdict.foot.normal.isZero(); }

}  // namespace

void add_points(std::span<const StreamEvent> events, const Localizer& localizer, const Tally& tally,
                SessionResult& result) {
  for (const StreamEvent& event : events) {
    if (event.kind == EventKind::reset) {
      result.points.clear();
      result.verdicts.clear();
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
