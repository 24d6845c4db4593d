#include "core/localizer/mode_fit.hpp"

#include <limits>

namespace bladefit {

ModeFit::ModeFit(const FitProblem& problem, const ModePlan& plan, const FootFinder& finder, PointStore& store,
                 PointSelection& selection, RunningSums& sums, PoseEstimate& estimate, VerdictBook& verdicts,
                 Sweep& sweep)
    : problem_(problem),
      plan_(plan),
      store_(store),
      selection_(selection),
      sums_(sums),
      estimate_(estimate),
      verdicts_(verdicts),
      sweep_(sweep),
      program_(problem, plan),
      sheets_(problem),
      starts_(problem, plan, finder, selection) {}

void ModeFit::attach(double* rows, KeptPlaces* places, std::uint32_t capacity) {
  program_.attach(rows, capacity);
  sheets_.attach(places);
}

void ModeFit::restart() {
  program_.restart();
  starts_.restart();
  sweeps_ = 0;
  why_ = FitEnd::none;
}

ModeFit::Next ModeFit::give_up(FitEnd why) {
  why_ = why;
  return Next::given_up;
}

/// Which points count from here on, and how tight their bounds are, is settled by their feet.
ModeFit::Next ModeFit::begin(bool at_squares) {
  selection_.hold(store_);
  (void)program_.assign_regions(store_, verdicts_);
  starts_.plan(estimate_.pose(), sums_.model());
  const PointSelection::Span span = selection_.distances(store_, 1);
  squares_range_ = span.most - span.least;
  if (at_squares && plan_.may_be_infeasible() && program_.bounds_hold(store_, selection_)) return Next::optimum;
  return begin_program(plan_.row().first, false);
}

/// `there`: at the pose of the last program. The next sweep takes rows: no foot needs a search.
ModeFit::Next ModeFit::begin_program(FitMode mode, bool there) {
  program_.begin(mode, store_.size());
  sheets_.begin(store_, there);
  sweep_.begin_again();
  return Next::begins;
}

/// At a pose where feet are not known yet.
ModeFit::Next ModeFit::begin_program_at(FitMode mode, const Pose& pose) {
  estimate_.move_to(pose);
  const Next next = begin_program(mode, false);
  sweep_.prove_next();
  return next;
}

void ModeFit::begin_sweep() {
  program_.set_pose(estimate_.pose());
  sheets_.begin_sweep(sweep_.proof(), program_);
}

FootStart ModeFit::start_of(std::uint32_t index) const { return {sheets_.kept(index), sweep_.search_of_kept()}; }

void ModeFit::note(std::uint32_t index, const Measurement& m, bool counts) {
  sheets_.note(index, store_[index], estimate_.pose(), m, counts, program_);
  if (!counts) program_.skip_row(index);
}

ModeFit::Next ModeFit::finish_sweep(bool concluded, ModeOptimum& optimum) {
  if (++sweeps_ > tuning::kModeSweeps) return give_up(FitEnd::sweeps_used_up);
  const double merit = program_.merit(sums_.model());
  switch (sheets_.weigh(merit, estimate_.pose(), store_.size())) {
    case SheetDescent::Outcome::same:
      break;
    case SheetDescent::Outcome::adopted:
      program_.compare_anew();
      break;
    case SheetDescent::Outcome::back:
      return go_on_from_proven();
    case SheetDescent::Outcome::stuck:
      return give_up(FitEnd::feet_changing);
  }
  const BoundedFit::Step step = program_.step(sums_.model());
  if (!succeeded(step.status)) return let_go(FitEnd::program_failed);
  if (step.settled && sweep_.proves()) return at_optimum(concluded, optimum);
  if (!step.from_last) {
    sheets_.accept(store_.size());
    sweep_.set_last_pose(estimate_.pose());
  }
  estimate_.move_to(problem_.moved_and_held(sweep_.last_pose(), step.x));
  estimate_.set_last_step(step.x.norm());
  sweep_.set_last_step(step.x);
  if (step.settled) sweep_.prove_next();
  return sweep_.number() < tuning::kProgramSweeps ? Next::goes_on : let_go(FitEnd::sweeps_used_up);
}

ModeFit::Next ModeFit::go_on_from_proven() {
  program_.compare_anew();
  estimate_.move_to(sheets_.proven_pose());
  return sweep_.number() < tuning::kProgramSweeps ? Next::goes_on : let_go(FitEnd::sweeps_used_up);
}

/// The program leads nowhere: once more, with nothing held.
ModeFit::Next ModeFit::let_go(FitEnd why) {
  if (sheets_.let_go(store_.size()) == SheetDescent::Outcome::stuck) return give_up(why);
  sweep_.begin_again();
  return go_on_from_proven();
}

/// What follows from an optimum: regions that follow their feet are assigned again; the second stage begins.
ModeFit::Next ModeFit::at_optimum(bool concluded, ModeOptimum& optimum) {
  switch (program_.follow_feet(store_, verdicts_)) {
    case ModeProgram::Regions::restless:
      return give_up(FitEnd::regions_restless);
    case ModeProgram::Regions::changed:
      return begin_program(plan_.row().first, true);
    case ModeProgram::Regions::at_rest:
      break;
  }
  optimum.stationarity = program_.stationarity();
  optimum.held_feet = program_.held_feet();
  const ModeRow& program = mode_row(program_.mode());
  const bool last = program.mode == plan_.row().last;
  const double value = program_.value();
  if (program.value_is_tolerance) optimum.smallest_tolerance = value * plan_.unit();
  if (!last && plan_.goes_on(value)) return begin_last_program();
  optimum.infeasible = !last;
  program_.report(store_, optimum);
  return program.has_value ? seek_better(value, concluded) : Next::optimum;
}

/// A range goes on from the least-squares optimum where its own is smaller there than at the minimax.
ModeFit::Next ModeFit::begin_last_program() {
  const FitMode last = plan_.row().last;
  if (last != FitMode::range || program_.range() <= squares_range_) return begin_program(last, true);
  return begin_program_at(last, starts_.centre());
}

ModeFit::Next ModeFit::begin_starts(double own_value, bool concluded) {
  const bool found = own_value < std::numeric_limits<double>::infinity();
  if (!concluded || problem_.config.further_starts == 0) return found ? Next::optimum : Next::given_up;
  starts_.begin(own_value, estimate_.pose(), store_.size(), program_);
  return Next::seeks;
}

/// An optimum over all points has been found.
ModeFit::Next ModeFit::seek_better(double value, bool concluded) {
  if (!starts_.done()) return begin_starts(value, concluded);
  const bool worse = value > starts_.own_value() * (1.0 + tuning::kSameOptimum);
  return worse ? go_back(Next::optimum) : Next::optimum;
}

ModeFit::Next ModeFit::go_elsewhere(bool concluded) {
  if (!mode_row(program_.mode()).has_value) return Next::given_up;
  return starts_.done() ? go_back(Next::given_up) : begin_starts(std::numeric_limits<double>::infinity(), concluded);
}

/// The best of the starts was not the best over all points: back to the optimum found before.
ModeFit::Next ModeFit::go_back(Next otherwise) {
  if (!starts_.go_back()) return otherwise;
  return begin_program_at(plan_.row().sought, starts_.own_pose());
}

ModeFit::Next ModeFit::start_on(bool proven, ModeOptimum& optimum) {
  switch (starts_.advance(store_, sums_.model(), program_, sheets_.sheets())) {
    case FurtherStarts::Outcome::running:
      return Next::goes_on;
    case FurtherStarts::Outcome::better:
      return begin_program_at(plan_.row().sought, starts_.best_pose());
    case FurtherStarts::Outcome::not_better:
      break;
  }
  if (!starts_.found_before()) return Next::given_up;
  if (!proven) return give_up(FitEnd::feet_unproven);
  optimum.infeasible = plan_.may_be_infeasible();
  return Next::optimum;
}

}  // namespace bladefit
