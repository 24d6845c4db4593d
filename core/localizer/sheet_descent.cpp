#include "core/localizer/sheet_descent.hpp"

#include <algorithm>

#include "core/fit/facing_row.hpp"

namespace bladefit {

std::uint32_t SheetDescent::Points::find(std::uint32_t i) const {
  return static_cast<std::uint32_t>(std::find(index.begin(), index.begin() + count, i) - index.begin());
}

bool SheetDescent::Points::add(std::uint32_t i) {
  if (count == index.size()) return false;
  index[count++] = i;
  return true;
}

void SheetDescent::begin(const PointStore& store, bool there) {
  for (std::uint32_t i = 0; i < store.size(); ++i) sheets_.keep(i, place_of(store[i]));
  if (!there) held_.count = 0;
  fresh_ = true;
  free_ = false;
  rounds_ = 0;
}

void SheetDescent::begin_sweep(ModeProgram& program) {
  others_.count = 0;
  any_other_ = false;
  program.set_limits(held_.count);
  for (std::uint32_t k = 0; k < held_.count; ++k) program.free_limit(k);
}

void SheetDescent::note(std::uint32_t index, const StoredPoint& point, const Pose& pose, const Measurement& m,
                        bool counts, ModeProgram& program) {
  sheets_.try_place(index, m.projection.place);
  if (!counts) return;
  if (m.changed) {
    any_other_ = true;
    (void)others_.add(index);
  }
  const std::uint32_t k = held_.find(index);
  if (k == held_.count || m.foot.kind != FootKind::interior) return;
  const Vec3 approach = pose.rotation * point.approach;
  const FacingRow row = facing_row(m.projection, m.foot.normal, m.r, approach, problem_.frame);
  Hold& hold = hold_[k];
  if (!hold.known) hold = {true, std::max(0.0, row.facing), row.gradient.norm()};
  if (!(hold.slope > 0.0)) return;
  const double margin = hold.allowed > 0.0 ? 0.0 : tuning::kFacesBy * problem_.frame.length;
  program.set_limit(k, (row.facing - hold.allowed) / hold.slope + margin, row.gradient / hold.slope);
}

SheetDescent::Outcome SheetDescent::weigh(bool proof, double merit, const Pose& pose, std::uint32_t count) {
  if (!proof && !fresh_) return Outcome::same;
  if (fresh_) first_merit_ = merit;
  const bool counts = fresh_ || merit <= proven_merit_ * (1.0 + tuning::kMeritRounding);
  if (counts) {
    fresh_ = false;
    proven_pose_ = pose;
    proven_merit_ = merit;
    sheets_.prove(count);
  }
  if (!any_other_) return merit <= first_merit_ * (1.0 + tuning::kSameOptimum) ? Outcome::same : Outcome::stuck;
  const bool last = ++rounds_ > tuning::kSheetRounds;
  if (counts || free_) {
    release_others();
    return last ? Outcome::stuck : Outcome::adopted;
  }
  if (last || !hold_others()) return let_go(count);
  sheets_.go_back(count);
  return Outcome::back;
}

SheetDescent::Outcome SheetDescent::let_go(std::uint32_t count) {
  if (free_) return Outcome::stuck;
  free_ = true;
  rounds_ = held_.count = 0;
  sheets_.go_back(count);
  return Outcome::back;
}

/// False where all are held already, or there is no more room.
bool SheetDescent::hold_others() {
  bool any = false;
  for (std::uint32_t k = 0; k < others_.count; ++k) {
    if (held_.holds(others_.index[k]) || !held_.add(others_.index[k])) continue;
    hold_[held_.count - 1] = Hold();  // known at the pose that is gone back to
    any = true;
  }
  return any;
}

/// Those on other sheets than they were held on.
void SheetDescent::release_others() {
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < held_.count; ++k) {
    if (others_.holds(held_.index[k])) continue;
    held_.index[kept] = held_.index[k];
    hold_[kept++] = hold_[k];
  }
  held_.count = kept;
}

}  // namespace bladefit
