#include "core/localizer/sheet_descent.hpp"

#include <algorithm>

#include "core/fit/existence_row.hpp"
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
  unproven_ = true;
  free_ = false;
  rounds_ = 0;
}

void SheetDescent::begin_sweep(bool proof, ModeProgram& program) {
  proof_ = proof;
  others_.count = 0;
  any_other_ = false;
  program.set_limits(2 * held_.count);
  for (std::uint32_t k = 0; k < 2 * held_.count; ++k) program.free_limit(k);
}

void SheetDescent::note(std::uint32_t index, const StoredPoint& point, const Pose& pose, const Measurement& m,
                        bool counts, ModeProgram& program) {
  sheets_.try_place(index, m.place);
  if (!counts) return;
  if (m.changed) {
    any_other_ = true;
    (void)others_.add(index);
  }
  const std::uint32_t k = held_.find(index);
  const bool elsewhere = proof_ && m.changed;  // weigh() decides between the two feet
  if (k < held_.count && !elsewhere && m.foot.kind == FootKind::interior)
    hold(k, pose.rotation * point.approach, m, program);
}

void SheetDescent::hold(std::uint32_t k, const Vec3& approach, const Measurement& m, ModeProgram& program) {
  Hold& hold = hold_[k];
  if (jumped(hold, m)) return program.refuse_pose();
  const Projection projection = m.projection();
  const FacingRow facing = facing_row(projection, m.foot.normal, m.r, approach, problem_.frame);
  const ExistenceRow row = existence_row(problem_.surface, projection, m.foot.normal, m.r, problem_.frame);
  const double missing = tuning::kLeastExistence - row.existence;
  if (!hold.known) {
    hold.known = true;
    hold.averted.begin(facing.facing, facing.gradient);
    hold.missing.begin(missing, -row.gradient);
  }
  const double margin = hold.averted.allowed > 0.0 ? 0.0 : tuning::kFacesBy * problem_.frame.length;
  hold.averted.set(2 * k, facing.facing, facing.gradient, margin, program);
  hold.missing.set(2 * k + 1, missing, -row.gradient, 0.0, program);
}

void SheetDescent::Limit::begin(double value, const Vec6& gradient) {
  allowed = std::max(0.0, value);
  slope = gradient.norm();
}

void SheetDescent::Limit::set(std::uint32_t k, double value, const Vec6& gradient, double margin,
                              ModeProgram& program) const {
  if (slope > 0.0) program.set_limit(k, (value - allowed) / slope + margin, gradient / slope);
}

/// A foot moves with its point, and its distance by no more than the point does; what changes by more is another foot.
bool SheetDescent::jumped(Hold& hold, const Measurement& m) const {
  hold.tried_r = m.r;
  hold.tried_distance = m.foot.distance;
  if (!hold.placed) {
    hold.placed = true;
    hold.r = m.r;
    hold.distance = m.foot.distance;
  }
  const double most = (m.r - hold.r).norm() + tuning::kSameFoot * problem_.frame.length;
  return std::abs(m.foot.distance - hold.distance) > most;
}

void SheetDescent::accept(std::uint32_t count) {
  sheets_.accept(count);
  for (std::uint32_t k = 0; k < held_.count; ++k) {
    hold_[k].r = hold_[k].tried_r;
    hold_[k].distance = hold_[k].tried_distance;
  }
}

SheetDescent::Outcome SheetDescent::weigh(double merit, const Pose& pose, std::uint32_t count) {
  if (!proof_ && !unproven_) return Outcome::same;
  if (unproven_) first_merit_ = merit;
  const bool counts = unproven_ || merit < proven_merit_ * (1.0 - tuning::kSameOptimum);
  if (counts) {
    unproven_ = false;
    proven_pose_ = pose;
    proven_merit_ = merit;
    sheets_.prove(count);
  }
  if (!any_other_) return merit <= first_merit_ * (1.0 + tuning::kSameOptimum) ? Outcome::same : Outcome::stuck;
  const bool again = free_ && std::abs(merit - free_merit_) <= tuning::kSameOptimum * merit;
  const bool last = ++rounds_ > tuning::kSheetRounds || again;
  free_merit_ = merit;
  for (std::uint32_t k = 0; k < held_.count; ++k) hold_[k].placed = false;
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
  free_merit_ = 0.0;
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
