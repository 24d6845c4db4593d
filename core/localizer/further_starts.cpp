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
  rests_.clear();
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
  start_.sweeps = start_.cursor = start_.others = start_.proofs = 0;
  start_.proves = false;
  start_.found.value = kInfinity;
  rests_.begin_start();
  program.begin(plan_.row().sought, points_);
  program.set_pose(start_.pose);
}

FurtherStarts::Outcome FurtherStarts::advance(PointStore& store, const QuadraticModel& model, ModeProgram& program,
                                              KeptSheets& sheets) {
  sweep_on(store, program, sheets);
  if (start_.cursor < points_) return Outcome::running;
  finish_sweep(model, program, sheets);
  if (phase_ == Phase::running) return Outcome::running;
  return best_.value < own_.found * (1.0 - tuning::kSameOptimum) ? Outcome::better : Outcome::not_better;
}

void FurtherStarts::sweep_on(PointStore& store, ModeProgram& program, KeptSheets& sheets) {
  std::array<std::uint32_t, kLanes> indices{};
  std::uint32_t count = 0;
  for (; count < kLanes && start_.cursor < points_; start_.cursor += stride_) indices[count++] = start_.cursor;
  const bool first = start_.sweeps == 0;
  finder_.find_each(
      store, {indices.data(), count}, start_.pose, Vec6::Zero(),
      [&](std::uint32_t i) {
        return FootStart{first ? place_of(store[i]) : sheets.kept(i), start_.proves ? Search::always : Search::keep};
      },
      [&](std::uint32_t i, const Measurement& tracked) {
        if (!first || !matters(program, i, tracked)) return take_in(store, i, tracked, program, sheets);
        take_in(store, i, finder_.find_from({place_of(store[i]), Search::always}, store[i], start_.pose), program,
                sheets);
      });
}

/// The first feet of a start are those of the optimum found before, tracked. Of what is far out the nearest are sought.
bool FurtherStarts::matters(const ModeProgram& program, std::uint32_t i, const Measurement& m) const {
  return own_.value == kInfinity ||
         std::abs(m.foot.distance) > tuning::kStartSearch * own_.value * program.unit_of(i, m.foot.distance);
}

void FurtherStarts::take_in(PointStore& store, std::uint32_t i, const Measurement& m, ModeProgram& program,
                            KeptSheets& sheets) {
  if (m.searched) store.count_search();
  if (m.changed) ++start_.others;
  sheets.try_place(i, m.place);
  if (selection_.left_out(store[i], m.foot)) {
    program.skip_row(i);
  } else {
    program.set_row(i, finder_.row(m, Vec6::Zero()));
  }
}

/// A start that has come to rest with a better value is proven: where feet are found on other sheets it goes on with
/// those, once or twice, as long as that leads anywhere else.
void FurtherStarts::finish_sweep(const QuadraticModel& model, ModeProgram& program, KeptSheets& sheets) {
  if (start_.proves && start_.others > 0) program.compare_anew();
  const bool proven = start_.proves && (start_.others == 0 || start_.proofs == tuning::kStartProofs);
  const BoundedFit::Step step = program.step(model);
  if (!step.from_last) sheets.accept(points_);
  const bool failed = !succeeded(step.status) || ++start_.sweeps == tuning::kStartSweeps;
  if (failed) return end_start(kInfinity, program);
  const double value = program.value();
  const bool worse = value >= best_.value * (1.0 - tuning::kSameOptimum);
  if ((step.settled && worse) || proven) return end_start(value, program);
  if (start_.proves) come_to(value);
  if (step.settled) {
    if (const double* outcome = rests_.outcome_of(value)) return end_start(*outcome, program);
    rests_.note(value);
    ++start_.proofs;
  }
  start_.proves = step.settled;
  start_.others = 0;
  if (!step.from_last) start_.last_pose = start_.pose;
  start_.pose = problem_.moved_and_held(start_.last_pose, step.x);
  start_.cursor = 0;
  program.set_pose(start_.pose);
}

/// The start under way is at this value, of feet that were all searched; infinite: at none. The least counts.
void FurtherStarts::come_to(double value) {
  if (value < start_.found.value) start_.found = {value, start_.pose};
  rests_.came_to(start_.found.value);
}

void FurtherStarts::end_start(double last_value, ModeProgram& program) {
  come_to(last_value);
  const double value = start_.found.value;
  if (start_.number == 0) own_.found = value;
  const auto same_as = [value](double other) { return std::abs(value - other) <= tuning::kSameOptimum * other; };
  if (start_.number > 0 && same_as(best_.value)) ++same_;
  if (start_.number > 0 && same_as(own_.found)) ++same_as_own_;
  if (value < best_.value * (1.0 - tuning::kSameOptimum)) {
    same_ = start_.number > 0 ? 1 : 0;
    best_ = start_.found;
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
