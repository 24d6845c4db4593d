#include "core/inspection/blade_verdict.hpp"

#include <cmath>

namespace bladefit {
namespace {

Reasons reasons_of(const BladeEvidence& e) {
  Reasons reasons = e.doubts;
  // A fit that is doubted elsewhere has told why already.
  const bool at_rest = e.converged || e.infeasible || e.doubts.any();
  reasons.add_if(!at_rest && e.determined >= e.free, Reason::not_converged);
  reasons.add_if(e.determined < e.free, Reason::underdetermined);
  reasons.add_if(e.unproven > 0, Reason::unproven);
  reasons.add_if(e.lost > 0, Reason::points_lost);
  reasons.add_if(e.refused > 0, Reason::points_refused);
  reasons.add_if(!e.finished, Reason::unfinished);
  if (reasons.doubt_the_fit()) return reasons;  // that no point is judged follows from it
  reasons.add_if(e.zones_missed > 0, Reason::zone_not_probed);
  reasons.add_if(e.judged && e.pending > 0, Reason::pending);
  reasons.add_if(e.undecided > 0, Reason::undecided);
  return reasons;
}

BladeState state_of(const BladeEvidence& e, const Reasons& reasons) {
  if (!e.judged) return BladeState::not_judged;
  if (reasons.doubt_the_fit()) return BladeState::not_decided;
  if (e.out > 0 || e.infeasible) return BladeState::out_of_tolerance;
  return reasons.any() ? BladeState::not_decided : BladeState::in_tolerance;
}

}  // namespace

BladeVerdict judge_blade(const BladeEvidence& evidence) {
  const Reasons reasons = reasons_of(evidence);
  return {state_of(evidence, reasons), reasons};
}

void ZoneCount::count(const Verdict& verdict, std::uint32_t sign) {
  if (!is_judged(verdict.state)) return;
  if (map_.zone_count > 0) {
    if (verdict.zone != 0) points_[verdict.zone - 1U] += sign;
    return;
  }
  const Foot& foot = verdict.foot;
  std::uint32_t counted = 0;  // a zone: on the common limit of two of its boxes a point is one point
  for (std::uint32_t k = 0; k < map_.box_count; ++k) {
    const ParameterBox& box = map_.boxes[k];
    const bool again = box.zone != 0 && box.zone == counted;
    if (again || !contains(box, foot.patch, foot.u, foot.v)) continue;
    points_[first_of_zone(map_, k)] += sign;
    counted = box.zone;
  }
}

bool ZoneCount::lacks_points(std::uint32_t k) const {
  if (map_.zone_count > 0) return std::isfinite(map_.zones[k].limits().nearer()) && points_[k] < map_.least_points;
  return std::isfinite(map_.leading_edge_mm) && first_of_zone(map_, k) == k && points_[k] < map_.least_points;
}

std::uint32_t ZoneCount::missed() const {
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < places(); ++k) count += lacks_points(k) ? 1U : 0U;
  return count;
}

}  // namespace bladefit
