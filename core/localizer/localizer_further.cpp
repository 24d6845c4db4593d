#include <cmath>
#include <limits>

#include "core/algebra/symmetric_eigen.hpp"
#include "core/localizer.hpp"

namespace bladefit {
namespace {

/// A start looks at every point where there are no more than these, and else at every second, third...
constexpr std::uint32_t kPointsLookedAt = 512;
/// How far off a start lies: distances change by this many times their root mean square.
constexpr double kFar = 1.5;
/// Sweeps of one start: six to ten are usual.
constexpr std::uint32_t kMaxSweeps = 30;
/// Values that differ by less than this share are the same optimum.
constexpr double kSame = 1e-7;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

/// At the least-squares optimum. The starts lie about it along the eigenvectors of its information matrix.
void Localizer::plan_further_starts() {
  FurtherStarts& f = refinement_.further;
  f.centre = pose_;
  f.own_value = kInfinity;
  const SymmetricEigen eigen = symmetric_eigen(current_.model.gauss);
  for (int k = 0; k < 6; ++k) {
    const double length = kFar * std::sqrt(2.0 * current_.model.half_square / eigen.values[k]);
    f.steps.col(k) = (length < reach() ? length : reach()) * eigen.vectors.col(k);
  }
}

/// Of a constrained fit the smallest feasible tolerance is sought, where it is not within the wanted one.
FitMode Localizer::sought_mode() const {
  return config_.mode == FitMode::constrained ? FitMode::min_tolerance : config_.mode;
}

/// The mode has found an optimum, or none: infinite. False: there is no further start.
bool Localizer::begin_further_starts(double own_value) {
  FurtherStarts& f = refinement_.further;
  if (f.done || !concluded_ || config_.further_starts == 0) return false;
  f.active = true;
  f.own_pose = pose_;
  f.own_value = own_value;
  f.stride = 1 + (stored_ - 1) / kPointsLookedAt;
  const bool compared = f.stride == 1 || own_value == kInfinity;
  f.best = kInfinity;
  if (compared) f.best = own_value;
  f.found = f.best;
  f.start = compared ? 1 : 0;
  for (std::uint32_t i = 0; i < stored_; ++i) bounded_.skip_row(i);
  begin_start();
  return true;
}

void Localizer::begin_start() {
  FurtherStarts& f = refinement_.further;
  f.pose = f.own_pose;
  if (f.start > 0) {
    const Vec6 step = f.steps.col((f.start - 1) / 2);
    const Pose pose = moved(f.centre, f.start % 2 == 1 ? step : Vec6(-step), frame_);
    f.pose = held(pose, config_.start, config_.locked);
  }
  f.sweeps = 0;
  bounded_.begin(sought_mode(), stored_, reach());
  begin_sweep();
}

/// Projects the next point of a start's sweep; every foot is searched globally. True when the refinement is over.
bool Localizer::visit_from_start(Status& status) {
  FurtherStarts& f = refinement_.further;
  const Measurement m = measure(points_[cursor_], f.pose, Search::always);
  if (left_out(points_[cursor_], m.foot)) {
    bounded_.skip_row(cursor_);
  } else {
    include_row(cursor_, row_of(m, Vec6::Zero()));
  }
  ++searches_;
  cursor_ += f.stride;
  if (cursor_ < stored_) return false;
  finish_start_sweep();
  return !f.active && end_further_starts(status);
}

void Localizer::finish_start_sweep() {
  FurtherStarts& f = refinement_.further;
  const BoundedFit::Step step = bounded_.step(current_.model);
  const bool failed = !succeeded(step.status) || ++f.sweeps == kMaxSweeps;
  if (failed || step.settled) return end_start(failed ? kInfinity : bounded_.value());
  if (!step.from_last) f.last_pose = f.pose;
  f.pose = held(moved(f.last_pose, step.x, frame_), config_.start, config_.locked);
  begin_sweep();
}

/// The start under way has led to an optimum of this value; infinite: to none.
void Localizer::end_start(double value) {
  FurtherStarts& f = refinement_.further;
  if (f.start == 0) f.found = value;
  if (f.start > 0 && std::abs(value - f.best) <= kSame * f.best) ++f.same;
  if (f.start > 0 && std::abs(value - f.found) <= kSame * f.found) ++f.same_as_own;
  if (value < f.best * (1.0 - kSame)) {
    f.same = f.start > 0 ? 1 : 0;
    f.best = value;
    f.best_pose = f.pose;
  }
  f.active = f.start++ < config_.further_starts;
  if (f.active) begin_start();
}

/// Goes on from the best of the starts, over all points. True where that is the optimum already found, or none was.
bool Localizer::end_further_starts(Status& status) {
  FurtherStarts& f = refinement_.further;
  f.done = true;
  if (f.best < f.found * (1.0 - kSame)) {
    pose_ = f.best_pose;
    ++revision_;
    begin_bounded(sought_mode());
    refinement_.thorough = true;
    begin_sweep();
    return false;
  }
  begin_sweep();  // the sweeps of starts have filled no sums
  converged_ = f.own_value < kInfinity && unproven_ == 0;
  infeasible_ = converged_ && config_.mode == FitMode::constrained;
  status = converged_ ? Status::ok : Status::iteration_cap;
  return true;
}

/// The best of the starts was not the best over all points: back to the optimum found before.
bool Localizer::go_back() {
  FurtherStarts& f = refinement_.further;
  if (!f.done || f.gone_back || f.own_value == kInfinity) return false;
  f.gone_back = true;
  f.same = f.same_as_own;
  pose_ = f.own_pose;
  ++revision_;
  begin_bounded(sought_mode());
  return true;
}

/// An optimum over all points has been found. True: the fit goes on elsewhere.
bool Localizer::seek_better(double value) {
  const FurtherStarts& f = refinement_.further;
  if (!f.done) return begin_further_starts(value);
  return value > f.own_value * (1.0 + kSame) && go_back();
}

/// A program has failed. True: the fit goes on elsewhere.
bool Localizer::go_elsewhere() {
  if (!refinement_.bounded || bounded_.mode() == FitMode::constrained) return false;
  return refinement_.further.done ? go_back() : begin_further_starts(kInfinity);
}

}  // namespace bladefit
