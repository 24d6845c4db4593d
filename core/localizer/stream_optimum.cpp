#include "core/localizer/stream_optimum.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {

void StreamOptimum::stop() {
  program_.stop();
  feasibility_.stop();
}

/// Middle of the signed distances.
double StreamOptimum::middle_distance(const PointStore& store, std::uint32_t stride) const {
  const PointSelection::Span span = selection_.distances(store, stride);
  return span.least <= span.most ? 0.5 * (span.least + span.most) : 0.0;
}

void StreamOptimum::Seeds::offer(std::uint32_t i, double how_far) {
  if (count == BoundTracker::kPlaces && how_far <= size[count - 1]) return;
  std::uint32_t place = count < BoundTracker::kPlaces ? count++ : count - 1;
  for (; place > 0 && size[place - 1] < how_far; --place) {
    size[place] = size[place - 1];
    index[place] = index[place - 1];
  }
  size[place] = how_far;
  index[place] = i;
}

StreamOptimum::Seeds StreamOptimum::seeds(const PointStore& store, std::uint32_t stride) const {
  Seeds out;
  const ModeRow::Compared compared = plan_.row().compared;
  const double middle = compared == ModeRow::Compared::by_range ? middle_distance(store, stride) : 0.0;
  for (std::uint32_t i = 0; i < store.size(); i += stride) {
    const Foot& foot = store[i].foot;
    const double weight = compared == ModeRow::Compared::by_bound ? plan_.weight(foot).of(foot.distance) : 1.0;
    if (selection_.left_out(store[i], foot) || weight == 0.0) continue;
    out.offer(i, std::abs(foot.distance - middle) / weight);
  }
  return out;
}

void StreamOptimum::begin(const PointStore& store, const Pose& pose, std::uint32_t stride) {
  program_.begin(plan_.row().last, pose, problem_.reach());
  if (plan_.may_be_infeasible()) feasibility_.begin(plan_.row().first, pose, problem_.reach());
  looked_at_ = 0;
  const Seeds found = seeds(store, stride);
  for (std::uint32_t k = 0; k < found.count; ++k) {
    program_.hold(found.index[k]);
    if (feasibility_.active()) feasibility_.hold(found.index[k]);
  }
}

void StreamOptimum::look_at(const PointStore& store, std::uint32_t index, const Measurement& m) {
  const StoredPoint& point = store[index];
  if (!program_.active() || selection_.left_out(point, m.foot)) return;
  const Limits weight = plan_.weight(m.foot);
  bool violated = weight.farther() > 0.0 && program_.violated(m.foot.distance, weight) && !program_.holds(index);
  if (violated) program_.hold(index);
  if (feasibility_.active() && !feasibility_.holds(index)) {
    const Foot foot = finder_.find(point, feasibility_.pose(), Search::keep).foot;
    const Limits bound = plan_.weight(foot);
    if (bound.farther() > 0.0 && feasibility_.violated(foot.distance, bound)) {
      feasibility_.hold(index);
      violated = true;
    }
  }
  looked_at_ = violated ? 0 : std::min(looked_at_ + 1, store.size());
}

/// The rows of the working set at the pose of the program. Each point keeps the sheet of its present foot, so that the
/// program is one problem: which foot is right is found when the point is looked at.
void StreamOptimum::set_rows(BoundTracker& tracker, const PointStore& store) const {
  const MotionBasis basis = free_motions(tracker.pose(), problem_.config.locked, problem_.frame);
  for (std::uint32_t place = 0; place < tracker.count(); ++place) {
    const StoredPoint& point = store[tracker.point(place)];
    const Measurement m = finder_.find(point, tracker.pose(), Search::keep);
    const Limits weight = plan_.weight(m.foot);
    if (selection_.left_out(point, m.foot) || weight.farther() == 0.0) {
      tracker.skip_row(place);
    } else {
      tracker.set_row(place, finder_.row(m, Vec6::Zero()), weight, basis);
    }
  }
}

/// Steps of a program until it rests, a few at most. False: it has no solution.
bool StreamOptimum::follow(BoundTracker& tracker, const PointStore& store, const QuadraticModel& model) {
  if (tracker.count() < std::min(BoundTracker::kPlaces, model.count)) return true;
  const LocalizerConfig& config = problem_.config;
  for (int k = 0; k < tuning::kProgramStepsPerPush && tracker.unsettled(); ++k) {
    const Pose pose = tracker.pose();
    set_rows(tracker, store);
    if (!tracker.step(shifted(model, pose, problem_.frame), problem_.frame, config.start, config.locked)) return false;
    const double length = motion_between(pose, tracker.pose(), problem_.frame).norm();
    if (length > tuning::kPoseAtRest * problem_.frame.length) looked_at_ = 0;
  }
  return true;
}

void StreamOptimum::follow(const PointStore& store, const QuadraticModel& model, const PoseEstimate& estimate,
                           ModeOptimum& optimum) {
  if (!estimate.determined()) stop();
  if (!program_.active()) {
    optimum.value = optimum.smallest_tolerance = 0.0;
    optimum.certificate = Certificate();
    if (!estimate.determined() || model.count < tuning::kLeastForProgram) return;
    begin(store, estimate.pose(), 1 + store.size() / tuning::kSeedPoints);
  }
  if (feasibility_.active()) {
    (void)follow(feasibility_, store, model);
    optimum.infeasible = !feasibility_.unsettled() && feasibility_.value() > 1.0 + tuning::kFeasibleInStream;
    program_.disturb();
  }
  // Where the tolerances cannot be met to first order from here, they can from where they are met best.
  if (!optimum.infeasible && !follow(program_, store, model) && feasibility_.active())
    program_.go_to(feasibility_.pose());

  const BoundTracker& found = telling();
  const double value = found.value() * plan_.unit();
  const bool feasible = plan_.may_be_infeasible() && !optimum.infeasible;
  const ModeRow& program = mode_row(feasible ? program_.mode() : found.mode());
  optimum.take(program, value, certificate_of(found.active_rows(), store, plan_.unit()));
  if (mode_row(found.mode()).value_is_tolerance) optimum.smallest_tolerance = value;
}

bool StreamOptimum::improving(const PointStore& store) const {
  const BoundTracker& program = plan_.may_be_infeasible() ? feasibility_ : program_;
  return !program.active() || program.unsettled() || looked_at_ < store.size();
}

}  // namespace bladefit
