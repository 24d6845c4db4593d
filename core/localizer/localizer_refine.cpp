#include <algorithm>
#include <cmath>
#include <limits>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

constexpr std::uint32_t kMaxSweeps = 100;
/// Steps [half diagonals]: a larger one must lower the sum of squares; a smaller one means convergence.
constexpr double kCheckedAbove = 1e-6;
constexpr double kConvergedBelow = 1e-12;
/// While the pose travels further than this between two sweeps [half diagonals], feet are searched anew: tracked ones
/// would be left on the wrong side of thin places, and the fit led to another optimum.
constexpr double kTravelsBeyond = 1e-3;
/// While it travels no further than this [half diagonals], which is how exact a search is, feet need no other one.
constexpr double kSearchHolds = 1e-10;

}  // namespace

void Localizer::begin_sweep() {
  filling_ = frozen_;
  filling_.model = shifted(frozen_.model, pose_, frame_);
  cursor_ = 0;
  const Pose& pose = refinement_.further.active ? refinement_.further.pose : pose_;
  if (refinement_.bounded) bounded_.set_basis(free_motions(pose, config_.locked, frame_));
  refinement_.travelled = motion_between(refinement_.rows_pose, pose_, frame_).norm();
  refinement_.since_search += refinement_.travelled;
  refinement_.rows_pose = pose_;
}

/// Points that were staged from a place are tracked until the last sweep: their lead is infinite.
Localizer::Search Localizer::sweep_search(const StoredPoint& point) const {
  if (refinement_.thorough) return proven_already() ? Search::if_doubtful : Search::always;
  const bool travels = refinement_.travelled > kTravelsBeyond * frame_.length && std::isfinite(point.rivals.lead);
  return travels ? Search::always : Search::if_doubtful;
}

/// A sweep before this one has searched every foot, and the pose has hardly moved since.
bool Localizer::proven_already() const { return refinement_.since_search <= kSearchHolds * frame_.length; }

/// The last step made the sum of squares larger: go back and take a quarter of it. False when it did not.
bool Localizer::retreat() {
  Refinement& r = refinement_;
  const QuadraticModel& model = current_.model;
  const bool comparable =
      r.sweeps > 1 && model.count == r.last_count && r.last_step.norm() > kCheckedAbove * frame_.length;
  if (!comparable || model.half_square <= r.last_value * (1.0 + 1e-9)) return false;
  r.last_step *= 0.25;
  pose_ = held(moved(r.last_pose, r.last_step, frame_), config_.start, config_.locked);
  ++revision_;
  return true;
}

/// The least-squares step at the end of a sweep. ok or underdetermined: this pose is the optimum.
Status Localizer::least_squares_step() {
  Refinement& r = refinement_;
  if (retreat()) return Status::more_work;
  r.last_value = current_.model.half_square;
  r.last_count = current_.model.count;
  r.last_pose = pose_;
  const double step = solve();
  r.last_step = motion_between(r.last_pose, pose_, frame_);
  if (!r.thorough || r.changed > 0 || step > kConvergedBelow * frame_.length) return Status::more_work;
  if (determination_.rank < 6) return Status::underdetermined;
  if (config_.mode == FitMode::least_squares) return adapt_loss() ? Status::more_work : Status::ok;
  begin_bounded(first_stage());
  return Status::more_work;
}

/// Closes a sweep of refine(): moves the pose and decides what comes next. True when the refinement is over.
bool Localizer::finish_refine_sweep(Status& status) {
  Refinement& r = refinement_;
  settled_ = current_ = filling_;
  redetermine_ = true;
  ++r.sweeps;
  status = r.bounded ? bounded_step() : least_squares_step();
  if (status == Status::more_work && r.sweeps >= kMaxSweeps) status = Status::iteration_cap;
  if (status == Status::iteration_cap && go_elsewhere()) status = Status::more_work;
  unproven_ = r.unproven;
  converged_ = status == Status::ok && unproven_ == 0;
  if (status == Status::ok && unproven_ > 0) status = Status::iteration_cap;
  infeasible_ = infeasible_ && converged_;
  if (r.unproven > 0) {
    r.since_search = std::numeric_limits<double>::infinity();
  } else if (r.thorough && !proven_already()) {
    r.since_search = 0.0;
  }
  r.thorough = r.last_step.norm() <= kCheckedAbove * frame_.length;
  r.changed = r.unproven = 0;
  begin_sweep();
  return status != Status::more_work;
}

/// Projects the next points of the sweep, at most kLanes. True when the refinement is over.
bool Localizer::visit_next(std::uint32_t count, Status& status) {
  std::array<std::uint32_t, kLanes> indices{};
  for (std::uint32_t k = 0; k < count; ++k) indices[k] = cursor_ + k;
  LaneBlock block;
  track(block, {indices.data(), count}, Vec6::Zero());
  for (std::uint32_t k = 0; k < count; ++k) visit(measure(block, k, sweep_search(points_[cursor_])));
  return cursor_ == stored_ && finish_refine_sweep(status);
}

/// Takes in the point of the sweep that was measured.
void Localizer::visit(const Measurement& m) {
  if (m.changed) ++refinement_.changed;
  if (!m.proven) ++refinement_.unproven;
  StoredPoint& point = points_[cursor_];
  const bool exits = !left_out(point, point.foot) && left_out(point, m.foot);
  if (exits && point.exits < UINT8_MAX) ++point.exits;
  note(point, m);
  if (left_out(point, m.foot)) {
    if (refinement_.bounded) bounded_.skip_row(cursor_);
  } else {
    const DistanceRow row = row_of(m, Vec6::Zero());
    add_row(filling_, point, m, row, Vec6::Zero());
    if (refinement_.bounded) include_row(cursor_, row);
  }
  ++cursor_;
}

Status Localizer::refine(std::uint32_t max_points) {
  if (stored_ == 0) return Status::underdetermined;
  if (converged_) return Status::ok;
  if (!refinement_.active) {
    refinement_ = Refinement();
    refinement_.active = true;
    regions_held_ = infeasible_ = false;
    exits_count_ = true;
    for (std::uint32_t i = 0; i < stored_; ++i) points_[i].exits = 0;
    begin_loss();
    stop_trackers();
    // What an earlier refinement found is not told beside what this one may fail to find.
    tolerance_factor_ = smallest_tolerance_ = stationarity_ = 0.0;
    certificate_ = Certificate();
    redetermine_ = true;
    settle_all();
    refinement_.rows_pose = pose_;
    solve();
    begin_sweep();
  }
  Status status = Status::more_work;
  for (std::uint32_t visited = 0, count = 0; visited < max_points; visited += count) {
    const bool further = refinement_.further.active;
    count = further ? 1 : std::min<std::uint32_t>({kLanes, max_points - visited, stored_ - cursor_});
    if (!(further ? visit_from_start(status) : visit_next(count, status))) continue;
    refinement_.active = false;
    for (std::uint32_t i = 0; i < stored_; ++i) rejudge(i);
    if (status == Status::ok && config_.mode != FitMode::least_squares) begin_trackers(1);
    return status;
  }
  return status;
}

}  // namespace bladefit
