#include "core/localizer/refinement.hpp"

#include <algorithm>

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
      sweep_(problem),
      mode_(problem, plan, finder, store, selection, sums, estimate, verdicts, sweep_) {}

void Refinement::clear() {
  phase_ = Phase::idle;
  mode_.restart();
  unproven_ = 0;
  ended_ = FitEnd::none;
}

void Refinement::interrupt() {
  ended_ = FitEnd::none;
  enter(Event::interrupted);
  mode_.interrupt();
}

void Refinement::begin(bool concluded, ModeOptimum& optimum) {
  enter(Event::began);
  selection_.by_exits(store_);
  loss_.restart();
  mode_.restart();
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
        status = start_on(call);
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
  if (phase_ == Phase::mode) mode_.begin_sweep();
}

/// Measures the next points of the sweep, up to where the next block of lanes begins, and returns how many.
std::uint32_t Refinement::sweep_on(std::uint32_t max_points) {
  std::array<std::uint32_t, kLanes> indices{};
  const std::uint32_t first = sums_.cursor(), to_next_block = kLanes - first % kLanes;
  const auto count = std::min<std::uint32_t>({to_next_block, max_points, store_.size() - first});
  for (std::uint32_t k = 0; k < count; ++k) indices[k] = first + k;
  LaneBlock block;
  finder_.find_block(
      store_, {indices.data(), count}, estimate_.pose(), Vec6::Zero(),
      [this](std::uint32_t index) { return start_of(index); },
      [this](std::uint32_t index, const LaneFoot& foot) { take_in(index, foot); },
      [this](std::uint32_t index, const Measurement& m) { take_in(index, m); }, block);
  sums_.end_block(block);
  return count;
}

FootStart Refinement::start_of(std::uint32_t index) const {
  if (phase_ == Phase::mode) return mode_.start_of(index);
  return {place_of(store_[index]), sweep_.search_of(store_[index])};
}

/// The sweep's next point was measured.
void Refinement::take_in(std::uint32_t index, const Measurement& m) {
  sweep_.count(m);
  StoredPoint& point = store_[index];
  selection_.note_exit(point, m.foot);
  store_.record(point, m, estimate_.revision());
  const bool of_mode = phase_ == Phase::mode, counts = !selection_.left_out(point, m.foot);
  if (of_mode) mode_.note(index, m, counts);
  if (!counts) return sums_.pass_over();
  const bool in_block = m.block != nullptr && sums_.in_block(m.lane);
  if (in_block && !of_mode) return sums_.sweep_in_block(point);
  const DistanceRow row = finder_.row(m, Vec6::Zero());
  if (of_mode) mode_.set_row(index, row);
  if (in_block) return sums_.sweep_in_block(point);
  sums_.sweep_over(point, m, row);
}

/// The same of a foot in a lane, which is no exit: only feet on edges are. In least squares nothing else is asked of
/// it.
void Refinement::take_in(std::uint32_t index, const LaneFoot& foot) {
  if (phase_ == Phase::mode || !sums_.in_block(foot.lane)) return take_in(index, finder_.measured(foot));
  StoredPoint& point = store_[index];
  store_.record(point, foot, problem_.surface, estimate_.revision());
  if (selection_.left_out(point, point.foot)) return sums_.pass_over();
  sums_.sweep_in_block(point);
}

/// Moves the pose and decides what comes next.
Status Refinement::finish_sweep(const Call& call) {
  sums_.commit();
  estimate_.redetermine();
  Status status = Status::more_work;
  if (phase_ == Phase::mode) {
    ModeFit::Next next = mode_.finish_sweep(call.concluded, call.optimum);
    if (next == ModeFit::Next::given_up) next = mode_.go_elsewhere(call.concluded);
    status = follow(next);
  } else {
    status = least_squares_step(call);
  }
  unproven_ = sweep_.unproven();
  if (status == Status::ok && unproven_ > 0) status = give_up(FitEnd::feet_unproven);
  call.optimum.infeasible = call.optimum.infeasible && status == Status::ok;
  sweep_.end();
  begin_sweep();
  return status;
}

/// What the mode's fit goes on with.
Status Refinement::follow(ModeFit::Next next) {
  switch (next) {
    case ModeFit::Next::goes_on:
      break;
    case ModeFit::Next::begins:
      enter(Event::program_began);
      break;
    case ModeFit::Next::seeks:
      enter(Event::starts_began);
      break;
    case ModeFit::Next::optimum:
      return Status::ok;
    case ModeFit::Next::given_up:
      return give_up(mode_.why());
  }
  return Status::more_work;
}

Status Refinement::start_on(const Call& call) {
  const Status status = follow(mode_.start_on(unproven_ == 0, call.optimum));
  if (phase_ == Phase::mode) {  // from another pose
    sweep_.end();
    begin_sweep();
  }
  return status;
}

Status Refinement::give_up(FitEnd why) {
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
  const bool last = sweep_.number() >= tuning::kRefineSweeps;
  if (feet_restless()) return follow(mode_.begin(false));
  if (retreat()) return last ? give_up(FitEnd::sweeps_used_up) : Status::more_work;
  descent_ = {sums_.model().half_square, sums_.model().count};
  sweep_.set_last_pose(estimate_.pose());
  const double step = solve(call.concluded);
  sweep_.set_last_step(motion_between(sweep_.last_pose(), estimate_.pose(), problem_.frame));
  if (!sweep_.last_step_counts()) sweep_.prove_next();
  if (!sweep_.proves() || step > tuning::kConvergedBelow * problem_.frame.length)
    return last ? give_up(FitEnd::sweeps_used_up) : Status::more_work;
  if (!last && selection_.readmit(store_)) {
    sweep_.begin_again();  // the sums are without them
    return Status::more_work;
  }
  if (!estimate_.determined()) return Status::underdetermined;
  if (plan_.bounded()) return follow(mode_.begin(true));
  if (!loss_.adapt(store_, selection_)) return Status::ok;
  sweep_.begin_again();  // the sums are of the old loss
  return Status::more_work;
}

/// Feet keep their sheets, and every foot was searched: some lie on other sheets again. The sum of squares may have no
/// minimum then that is one of its own feet; the programs of a mode need a start alone.
bool Refinement::feet_restless() const {
  const bool other_feet = sweep_.proof() && !sweep_.proves();
  return plan_.bounded() && other_feet && sweep_.number() > tuning::kFreeSearchSweeps && estimate_.determined();
}

/// The last step made the sum of squares larger: go back and take a quarter of it. False when it did not.
bool Refinement::retreat() {
  const QuadraticModel& model = sums_.model();
  const bool comparable = sweep_.number() > 1 && model.count == descent_.count && sweep_.last_step_counts();
  if (!comparable || model.half_square <= descent_.value * (1.0 + 1e-9)) return false;
  sweep_.set_last_step(0.25 * sweep_.last_step());
  if (!sweep_.last_step_counts()) sweep_.prove_next();
  estimate_.move_to(problem_.moved_and_held(sweep_.last_pose(), sweep_.last_step()));
  return true;
}

}  // namespace bladefit
