#include <algorithm>
#include <cmath>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

/// Regions follow the feet this many times at most: then they do not come to rest.
constexpr std::uint32_t kMaxRounds = 20;
/// So many times they do so freely; then tolerances only become tighter.
constexpr std::uint32_t kFreeRounds = 3;
/// Weights that change by less than this share are at rest.
constexpr double kAtRest = 1e-10;
/// A tolerance below the smallest feasible one by no more than this share is met.
constexpr double kFeasible = 1e-12;

}  // namespace

/// Weights and regions of all points from their present feet. Returns the largest relative change of a weight.
double Localizer::assign_regions() {
  double change = 0.0;
  for (std::uint32_t i = 0; i < stored_; ++i) {
    StoredPoint& point = points_[i];
    const Foot& foot = point.foot;
    const double weight = bound_weight(foot);
    // A foot on the border of a region may be drawn over it by one bound and back by the other: it keeps the tighter.
    const double kept = bounded_.weight(i);
    if (refinement_.rounds >= kFreeRounds && kept > 0.0 && (weight == 0.0 || weight > kept)) continue;
    count_verdict(point, -1);
    point.region = region_at(config_.tolerance, foot.patch, foot.u, foot.v);
    point.tolerance = tolerance_at(config_.tolerance, foot.patch, foot.u, foot.v);
    count_verdict(point, +1);
    change = std::max(change, bounded_.set_weight(i, weight));
  }
  return change;
}

/// A constrained fit begins with the smallest feasible tolerance. A range begins with the minimax, from where it meets
/// its best optimum more often: with few points it has several.
FitMode Localizer::first_stage() const {
  switch (config_.mode) {
    case FitMode::constrained:
      return FitMode::min_tolerance;
    case FitMode::range:
      return FitMode::minimax;
    default:
      return config_.mode;
  }
}

void Localizer::begin_bounded(FitMode mode) {
  Refinement& r = refinement_;
  if (!r.bounded) {
    // Which points count is settled by the least-squares fit: none escapes its bound over an edge.
    for (std::uint32_t i = 0; i < stored_; ++i) points_[i].held_out = left_out(points_[i], points_[i].foot);
    (void)assign_regions();
    plan_further_starts();
  }
  regions_held_ = r.bounded = true;
  bounded_.begin(mode, stored_, reach());
  r.last_step.setConstant(frame_.length);  // the next sweep takes rows at the same pose: no foot needs a search
  r.sweeps = 0;
}

void Localizer::include_row(std::uint32_t index, const DistanceRow& row) {
  if (bounded_.weight(index) == 0.0) {
    bounded_.skip_row(index);
  } else {
    bounded_.set_row(index, row);
  }
}

/// The step of the mode at the end of a sweep. ok: this pose is the optimum, proven by its multipliers.
Status Localizer::bounded_step() {
  Refinement& r = refinement_;
  const BoundedFit::Step step = bounded_.step(current_.model);
  if (!succeeded(step.status)) return Status::iteration_cap;
  if (step.settled && r.thorough && r.changed == 0) return bounded_optimum();
  if (!step.from_last) r.last_pose = pose_;
  pose_ = held(moved(r.last_pose, step.x, frame_), config_.start, config_.locked);
  r.last_step = step.x;
  last_step_ = step.x.norm();
  ++revision_;
  return Status::more_work;
}

/// What follows from an optimum: regions that follow their feet are assigned anew; the second stage begins, which for
/// a constrained fit it does where the smallest feasible tolerance is within the wanted one.
Status Localizer::bounded_optimum() {
  Refinement& r = refinement_;
  if (config_.regions == RegionPolicy::follow && assign_regions() > kAtRest) {
    if (++r.rounds >= kMaxRounds) return Status::iteration_cap;
    begin_bounded(first_stage());
    return Status::more_work;
  }
  stationarity_ = bounded_.stationarity();
  const bool optimum = bounded_.mode() == config_.mode;
  // The weights of a constrained fit are its tolerances, those of min_tolerance are 1 at the leading edge.
  const double value = bounded_.value();
  if (bounded_.mode() == FitMode::min_tolerance) smallest_tolerance_ = value * bound_unit();
  if (!optimum && (config_.mode == FitMode::range || value <= 1.0 + kFeasible)) {
    begin_bounded(config_.mode);
    return Status::more_work;
  }
  infeasible_ = !optimum;
  certify();
  return bounded_.mode() != FitMode::constrained && seek_better(value) ? Status::more_work : Status::ok;
}

/// What is told of an optimum: its value and the points that prove it.
void Localizer::certify() {
  certificate_ = Certificate();
  tolerance_factor_ = 0;
  if (bounded_.mode() == FitMode::constrained) return;
  tolerance_factor_ = bounded_.value() * bound_unit();
  if (bounded_.mode() == FitMode::range) return;
  certificate_ = bounded_.certificate();
  name_points(certificate_);
}

}  // namespace bladefit
