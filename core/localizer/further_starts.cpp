#include "core/localizer/further_starts.hpp"

#include <cmath>
#include <limits>

#include "core/algebra/symmetric_eigen.hpp"

namespace bladefit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void FurtherStarts::restart() {
  phase_ = Phase::waiting;
  same_ = same_as_own_ = 0;
}

void FurtherStarts::interrupt() {
  if (phase_ == Phase::running) phase_ = Phase::waiting;
}

bool FurtherStarts::found_before() const { return own_.value < kInfinity; }

void FurtherStarts::plan(const Pose& centre, const QuadraticModel& model) {
  centre_ = centre;
  own_.value = kInfinity;
  const SymmetricEigen eigen = symmetric_eigen(model.gauss);
  for (int k = 0; k < 6; ++k) {
    const double length = tuning::kStartDistance * std::sqrt(2.0 * model.half_square / eigen.values[k]);
    steps_.col(k) = (length < problem_.reach() ? length : problem_.reach()) * eigen.vectors.col(k);
  }
}

void FurtherStarts::begin(double own_value, const Pose& own_pose, std::uint32_t points, ModeProgram& program) {
  phase_ = Phase::running;
  own_.pose = own_pose;
  own_.value = own_value;
  points_ = points;
  stride_ = 1 + (points - 1) / tuning::kStartPoints;
  const bool compared = stride_ == 1 || own_value == kInfinity;
  best_.value = kInfinity;
  if (compared) best_.value = own_value;
  own_.found = best_.value;
  start_.number = compared ? 1 : 0;
  for (std::uint32_t i = 0; i < points; ++i) program.skip_row(i);
  begin_start(program);
}

void FurtherStarts::begin_start(ModeProgram& program) {
  start_.pose = own_.pose;
  if (start_.number > 0) {
    const Vec6 step = steps_.col((start_.number - 1) / 2);
    start_.pose = problem_.moved_and_held(centre_, start_.number % 2 == 1 ? step : Vec6(-step));
  }
  start_.sweeps = start_.cursor = 0;
  program.begin(plan_.row().sought, points_);
  program.set_pose(start_.pose);
}

FurtherStarts::Outcome FurtherStarts::advance(PointStore& store, const QuadraticModel& model, ModeProgram& program) {
  const StoredPoint& point = store[start_.cursor];
  const Measurement m = finder_.find(point, start_.pose, Search::always);
  if (selection_.left_out(point, m.foot)) {
    program.skip_row(start_.cursor);
  } else {
    program.set_row(start_.cursor, finder_.row(m, Vec6::Zero()));
  }
  store.count_search();
  start_.cursor += stride_;
  if (start_.cursor < points_) return Outcome::running;
  finish_sweep(model, program);
  if (phase_ == Phase::running) return Outcome::running;
  return best_.value < own_.found * (1.0 - tuning::kSameOptimum) ? Outcome::better : Outcome::not_better;
}

void FurtherStarts::finish_sweep(const QuadraticModel& model, ModeProgram& program) {
  const BoundedFit::Step step = program.step(model);
  const bool failed = !succeeded(step.status) || ++start_.sweeps == tuning::kStartSweeps;
  if (failed || step.settled) return end_start(failed ? kInfinity : program.value(), program);
  if (!step.from_last) start_.last_pose = start_.pose;
  start_.pose = problem_.moved_and_held(start_.last_pose, step.x);
  start_.cursor = 0;
  program.set_pose(start_.pose);
}

/// The start under way has led to an optimum of this value; infinite: to none.
void FurtherStarts::end_start(double value, ModeProgram& program) {
  if (start_.number == 0) own_.found = value;
  const auto same_as = [value](double other) { return std::abs(value - other) <= tuning::kSameOptimum * other; };
  if (start_.number > 0 && same_as(best_.value)) ++same_;
  if (start_.number > 0 && same_as(own_.found)) ++same_as_own_;
  if (value < best_.value * (1.0 - tuning::kSameOptimum)) {
    same_ = start_.number > 0 ? 1 : 0;
    best_ = {value, start_.pose};
  }
  if (start_.number++ < problem_.config.further_starts) {
    begin_start(program);
  } else {
    phase_ = Phase::done;
  }
}

bool FurtherStarts::go_back() {
  if (phase_ != Phase::done || !found_before()) return false;
  phase_ = Phase::went_back;
  same_ = same_as_own_;
  return true;
}

}  // namespace bladefit
