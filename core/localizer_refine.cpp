#include <algorithm>
#include <cmath>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

constexpr std::uint32_t kMaxSweeps = 100;
/// Steps [half diagonals]: a larger one must lower the sum of squares; a smaller one means convergence.
constexpr double kCheckedAbove = 1e-6;
constexpr double kConvergedBelow = 1e-12;

}  // namespace

void Localizer::begin_sweep() {
  filling_ = frozen_;
  filling_.model = shifted(frozen_.model, pose_, frame_);
  cursor_ = 0;
}

/// The last step made the sum of squares larger: go back and take a quarter of it. False when it did not.
bool Localizer::retreat() {
  Refinement& r = refinement_;
  const QuadraticModel& model = current_.model;
  const bool comparable =
      r.sweeps > 1 && model.count == r.last_count && r.last_step.norm() > kCheckedAbove * frame_.length;
  if (!comparable || model.half_square <= r.last_value * (1.0 + 1e-9)) return false;
  r.last_step *= 0.25;
  pose_ = moved(r.last_pose, r.last_step, frame_);
  ++revision_;
  return true;
}

/// Closes a sweep of refine(): moves the pose and decides what comes next. True when the refinement is over.
bool Localizer::finish_refine_sweep(Status& status) {
  Refinement& r = refinement_;
  settled_ = current_ = filling_;
  redetermine_ = true;
  ++r.sweeps;
  if (!retreat()) {
    r.last_value = current_.model.half_square;
    r.last_count = current_.model.count;
    r.last_pose = pose_;
    const double step = solve();
    r.last_step = motion_between(r.last_pose, pose_, frame_);
    if (r.thorough && r.changed == 0 && step <= kConvergedBelow * frame_.length) {
      converged_ = determination_.rank == 6;
      status = converged_ ? Status::ok : Status::underdetermined;
    }
  }
  r.thorough = r.last_step.norm() <= kCheckedAbove * frame_.length;
  r.changed = 0;
  if (status == Status::more_work && r.sweeps >= kMaxSweeps) status = Status::iteration_cap;
  begin_sweep();
  return status != Status::more_work;
}

Status Localizer::refine(std::uint32_t max_points) {
  if (stored_ == 0) return Status::underdetermined;
  if (converged_) return Status::ok;
  if (!refinement_.active) {
    refinement_ = Refinement();
    refinement_.active = true;
    redetermine_ = true;
    settle_all();
    solve();
    begin_sweep();
  }
  Status status = Status::more_work;
  for (std::uint32_t k = 0; k < max_points; ++k) {
    if (refinement_.thorough) points_[cursor_].lead = 0.0;
    const Measurement m = measure(points_[cursor_], pose_);
    if (m.changed) ++refinement_.changed;
    review(cursor_, m);
    include(filling_, points_[cursor_], m, Vec6::Zero());
    ++cursor_;
    if (cursor_ < stored_) continue;
    if (!finish_refine_sweep(status)) continue;
    refinement_.active = false;
    for (std::uint32_t i = 0; i < stored_; ++i) rejudge(i);
    return status;
  }
  return status;
}

}  // namespace bladefit
