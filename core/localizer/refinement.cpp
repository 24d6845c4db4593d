#include "core/localizer/refinement.hpp"

#include <algorithm>
#include <limits>
#include <cstdio>
#include <cstdlib>

namespace bladefit {

using Phase = RefinementPhase;
using Event = RefinementEvent;

Refinement::Refinement(const FitProblem& problem, const ModePlan& plan, const FootFinder& finder, PointStore& store,
                       PointSelection& selection, RunningSums& sums, PoseEstimate& estimate, LossSchedule& loss,
                       VerdictBook& verdicts)
    : problem_(problem),
      plan_(plan),
      finder_(finder),
      store_(store),
      selection_(selection),
      sums_(sums),
      estimate_(estimate),
      loss_(loss),
      verdicts_(verdicts),
      sweep_(problem),
      program_(problem, plan),
      descent_sheets_(problem, finder),
      starts_(problem, plan, finder, selection) {}

void Refinement::clear() {
  phase_ = Phase::idle;
  starts_.restart();
  unproven_ = 0;
  ended_ = FitEnd::none;
}

void Refinement::interrupt() {
  ended_ = FitEnd::none;
  enter(Event::interrupted);
  starts_.interrupt();
}

void Refinement::begin(bool concluded, ModeOptimum& optimum) {
  enter(Event::began);
  selection_.by_exits(store_);
  loss_.restart();
  program_.restart();
  starts_.restart();
  ended_ = FitEnd::none;
  optimum = ModeOptimum();  // an earlier optimum is not reported beside a failed search
  estimate_.redetermine();
  sums_.settle_all(store_, estimate_);
  sweep_.restart(estimate_.pose());
  (void)solve(concluded);
  begin_sweep();
}

Status Refinement::advance(std::uint32_t max_points, bool concluded, ModeOptimum& optimum) {
  const Call call{concluded, optimum};
  Status status = Status::more_work;
  for (std::uint32_t visited = 0; visited < max_points && status == Status::more_work;) {
    switch (phase_) {
      case Phase::least_squares:
      case Phase::mode:
        visited += sweep_on(max_points - visited);
        if (sums_.cursor() == store_.size()) status = finish_sweep(call);
        break;
      case Phase::further_starts:
        visited += kLanes;
        status = start_on(optimum);
        break;
      case Phase::done:
        return Status::ok;
      case Phase::idle:
        return Status::underdetermined;
    }
  }
  if (status == Status::ok) ended_ = FitEnd::none;
  if (status != Status::more_work) enter(status == Status::ok ? Event::converged : Event::ended_unconverged);
  return status;
}

void Refinement::begin_sweep() {
  sums_.begin_sweep(estimate_.pose());
  sweep_.begin(estimate_.pose());
  if (phase_ != Phase::mode) return;
  program_.set_pose(estimate_.pose());
  descent_sheets_.begin_sweep(program_);
}

/// Measures the next points of the sweep and returns how many: as many as there are lanes, where there are so many.
std::uint32_t Refinement::sweep_on(std::uint32_t max_points) {
  std::array<std::uint32_t, kLanes> indices{};
  const auto count = std::min<std::uint32_t>({kLanes, max_points, store_.size() - sums_.cursor()});
  for (std::uint32_t k = 0; k < count; ++k) indices[k] = sums_.cursor() + k;
  finder_.find_each(
      store_, {indices.data(), count}, estimate_.pose(), Vec6::Zero(),
      [this](std::uint32_t index) {
        if (phase_ == Phase::mode) return FootStart{descent_sheets_.sheets().kept(index), sweep_.search_of_kept()};
        return FootStart{place_of(store_[index]), sweep_.search_of(store_[index])};
      },
      [this](std::uint32_t index, const Measurement& m) { take_in(index, m); });
  return count;
}

/// The sweep's next point was measured.
void Refinement::take_in(std::uint32_t index, const Measurement& m) {
  sweep_.count(m);
  StoredPoint& point = store_[index];
  selection_.note_exit(point, m.foot);
  store_.record(point, m, estimate_.revision());
  const bool has_program = phase_ == Phase::mode;
  const bool counts = !selection_.left_out(point, m.foot);
  if (has_program) descent_sheets_.note(index, point, estimate_.pose(), m, counts, program_);
  if (!counts) {
    if (has_program) program_.skip_row(index);
    sums_.pass_over();
    return;
  }
  const DistanceRow row = finder_.row(m, Vec6::Zero());
  if (m.changed && has_program && getenv("TRACE")) {
    const Projection was = project_local(problem_.surface, m.r, descent_sheets_.sheets().kept(index));
    const Foot f = foot_of(problem_.surface, was, 0.0);
    const Vec3 a = estimate_.pose().rotation * point.approach;
    fprintf(stderr, "TRACE   point %u: d %.6f (n.a %.4f kind %d conv %d at %.4f %.4f) -> d %.6f (n.a %.4f kind %d at %.4f %.4f)\n", point.sequence, f.distance, f.normal.dot(a), (int)f.kind, (int)was.converged, f.u, f.v, m.foot.distance, m.foot.normal.dot(a), (int)m.foot.kind, m.foot.u, m.foot.v);
  }
  sums_.sweep_over(point, m, row);
  if (has_program) program_.set_row(index, row);
}

/// Moves the pose and decides what comes next.
Status Refinement::finish_sweep(const Call& call) {
  sums_.commit();
  estimate_.redetermine();
  proof_wanted_ = false;
  Status status = phase_ == Phase::mode ? program_step(call) : least_squares_step(call);
  if (status == Status::more_work && sweep_.number() >= most_sweeps()) status = given_up(FitEnd::sweeps_used_up);
  if (status == Status::iteration_cap && go_elsewhere(call.concluded)) status = Status::more_work;
  unproven_ = sweep_.unproven();
  if (status == Status::ok && unproven_ > 0) status = given_up(FitEnd::feet_unproven);
  call.optimum.infeasible = call.optimum.infeasible && status == Status::ok;
  sweep_.end(proof_wanted_);
  begin_sweep();
  return status;
}

std::uint32_t Refinement::most_sweeps() const {
  return phase_ == Phase::mode ? tuning::kProgramSweeps : tuning::kRefineSweeps;
}

Status Refinement::given_up(FitEnd why) {
  ended_ = why;
  return Status::iteration_cap;
}

/// Returns the length of the step [mm at the half diagonal].
double Refinement::solve(bool concluded) {
  const Minimum minimum =
      estimate_.minimum_of(sums_.model(), loss_, concluded, PoseEstimate::Undetermined::as_they_are);
  estimate_.know(minimum);
  estimate_.move_to(minimum.pose);
  return minimum.step;
}

/// ok or underdetermined: this pose is the optimum.
Status Refinement::least_squares_step(const Call& call) {
  if (retreat()) return Status::more_work;
  descent_ = {sums_.model().half_square, sums_.model().count};
  sweep_.set_last_pose(estimate_.pose());
  const double step = solve(call.concluded);
  sweep_.set_last_step(motion_between(sweep_.last_pose(), estimate_.pose(), problem_.frame));
  proof_wanted_ = !sweep_.last_step_counts();
  if (!sweep_.proves() || step > tuning::kConvergedBelow * problem_.frame.length) return Status::more_work;
  if (!estimate_.determined()) return Status::underdetermined;
  if (plan_.bounded()) {
    settle_selection();
    if (plan_.may_be_infeasible() && program_.bounds_hold(store_, selection_)) return Status::ok;
    begin_program(plan_.row().first, false);
    return Status::more_work;
  }
  if (!loss_.adapt(store_, selection_)) return Status::ok;
  proof_wanted_ = false;
  sweep_.begin_again();  // the sums are of the old loss
  return Status::more_work;
}

/// The last step made the sum of squares larger: go back and take a quarter of it. False when it did not.
bool Refinement::retreat() {
  const QuadraticModel& model = sums_.model();
  const bool comparable = sweep_.number() > 1 && model.count == descent_.count && sweep_.last_step_counts();
  if (!comparable || model.half_square <= descent_.value * (1.0 + 1e-9)) return false;
  sweep_.set_last_step(0.25 * sweep_.last_step());
  proof_wanted_ = !sweep_.last_step_counts();
  estimate_.move_to(problem_.moved_and_held(sweep_.last_pose(), sweep_.last_step()));
  return true;
}

/// At the least-squares optimum: which points count from here on, and how tight their bounds are.
void Refinement::settle_selection() {
  selection_.hold(store_);
  (void)program_.assign_regions(store_, verdicts_);
  starts_.plan(estimate_.pose(), sums_.model());
  const PointSelection::Span span = selection_.distances(store_, 1);
  squares_range_ = span.most - span.least;
}

/// `there`: at the pose of the last program.
void Refinement::begin_program(FitMode mode, bool there) {
  enter(Event::program_began);
  program_.begin(mode, store_.size());
  descent_sheets_.begin(store_, there);
  proof_wanted_ = false;
  sweep_.begin_again();  // the next sweep takes rows at the same pose: no foot needs a search
}

/// ok: this pose is the optimum, proven by its multipliers.
Status Refinement::program_step(const Call& call) {
  const double merit = program_.merit(sums_.model());
  const SheetDescent::Outcome outcome = descent_sheets_.weigh(sweep_.proof(), merit, estimate_.pose(), store_.size());
  if (getenv("TRACE") && outcome != SheetDescent::Outcome::same) fprintf(stderr, "TRACE outcome %d merit %.9g\n", (int)outcome, merit);
  if (outcome == SheetDescent::Outcome::stuck) return given_up(FitEnd::feet_changing);
  if (outcome != SheetDescent::Outcome::same) program_.compare_anew();
  if (outcome == SheetDescent::Outcome::back) {
    estimate_.move_to(descent_sheets_.proven_pose());
    sweep_.set_last_step(Vec6::Constant(problem_.frame.length));
    return Status::more_work;
  }
  const double tr_value = program_.value();
  if (getenv("TRACE")) { std::uint32_t w = 0; for (std::uint32_t i = 0; i < store_.size(); ++i) if (!selection_.left_out(store_[i], store_[i].foot) && std::abs(store_[i].foot.distance) > std::abs(store_[w].foot.distance)) w = i; const Foot& f = store_[w].foot; fprintf(stderr, "TRACE worst %u d %.9g kind %d at %.6f %.6f n.a %.4f limits %u\n", store_[w].sequence, f.distance, (int)f.kind, f.u, f.v, f.normal.dot(estimate_.pose().rotation * store_[w].approach), program_.held_feet()); }
  const BoundedFit::Step step = program_.step(sums_.model());
  if (getenv("TRACE")) fprintf(stderr, "TRACE sweep %u mode %d thorough %d others %u value %.9g status %d step %.3g from_last %d settled %d\n", sweep_.number(), (int)program_.mode(), (int)sweep_.proof(), sweep_.changed(), tr_value, (int)step.status, step.x.norm(), (int)step.from_last, (int)step.settled);
  if (!step.from_last) descent_sheets_.accept(store_.size());
  if (!succeeded(step.status)) return given_up(FitEnd::program_failed);
  if (step.settled && sweep_.proves()) return program_optimum(call);
  if (!step.from_last) sweep_.set_last_pose(estimate_.pose());
  estimate_.move_to(problem_.moved_and_held(sweep_.last_pose(), step.x));
  sweep_.set_last_step(step.x);
  proof_wanted_ = step.settled;
  estimate_.set_last_step(step.x.norm());
  return Status::more_work;
}

/// What follows from an optimum: regions that follow their feet are assigned again; the second stage begins.
Status Refinement::program_optimum(const Call& call) {
  switch (program_.follow_feet(store_, verdicts_)) {
    case ModeProgram::Regions::restless:
      return given_up(FitEnd::regions_restless);
    case ModeProgram::Regions::changed:
      begin_program(plan_.row().first, true);
      return Status::more_work;
    case ModeProgram::Regions::at_rest:
      break;
  }
  ModeOptimum& optimum = call.optimum;
  optimum.stationarity = program_.stationarity();
  optimum.held_feet = program_.held_feet();
  const ModeRow& program = mode_row(program_.mode());
  const bool last = program.mode == plan_.row().mode;
  const double value = program_.value();
  if (program.value_is_tolerance) optimum.smallest_tolerance = value * plan_.unit();
  if (!last && plan_.goes_on(value)) {
    const bool worse = plan_.row().then == ModeRow::Then::always && program_.range() > squares_range_;
    if (worse) estimate_.move_to(starts_.centre());
    begin_program(plan_.row().mode, !worse);
    if (worse) proof_wanted_ = true;
    return Status::more_work;
  }
  optimum.infeasible = !last;
  program_.report(store_, optimum);
  return program.has_value && seek_better(value, call.concluded) ? Status::more_work : Status::ok;
}

bool Refinement::begin_starts(double own_value, bool concluded) {
  if (starts_.done() || !concluded || problem_.config.further_starts == 0) return false;
  enter(Event::starts_began);
  starts_.begin(own_value, estimate_.pose(), store_.size(), program_);
  return true;
}

/// An optimum over all points has been found. True: the fit goes on from another pose.
bool Refinement::seek_better(double value, bool concluded) {
  if (!starts_.done()) return begin_starts(value, concluded);
  return value > starts_.own_value() * (1.0 + tuning::kSameOptimum) && go_back();
}

/// A program has failed. True: the fit goes on from another pose.
bool Refinement::go_elsewhere(bool concluded) {
  if (phase_ != Phase::mode || !mode_row(program_.mode()).has_value) return false;
  return starts_.done() ? go_back() : begin_starts(std::numeric_limits<double>::infinity(), concluded);
}

/// The best of the starts was not the best over all points: back to the optimum found before.
bool Refinement::go_back() {
  if (!starts_.go_back()) return false;
  estimate_.move_to(starts_.own_pose());
  begin_program(plan_.row().sought, false);
  proof_wanted_ = true;
  return true;
}

/// Measures the next point of a start. After the last start the fit goes on from the best one, over all points, unless
/// that is the optimum already found, or none was.
Status Refinement::start_on(ModeOptimum& optimum) {
  switch (starts_.advance(store_, sums_.model(), program_, descent_sheets_.sheets())) {
    case FurtherStarts::Outcome::running:
      return Status::more_work;
    case FurtherStarts::Outcome::better:
      estimate_.move_to(starts_.best_pose());
      begin_program(plan_.row().sought, false);
      sweep_.prove();
      begin_sweep();
      return Status::more_work;
    case FurtherStarts::Outcome::not_better:
      break;
  }
  const bool converged = starts_.found_before() && unproven_ == 0;
  optimum.infeasible = converged && plan_.may_be_infeasible();
  return converged ? Status::ok : Status::iteration_cap;
}

}  // namespace bladefit
