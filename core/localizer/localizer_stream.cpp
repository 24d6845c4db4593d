#include <algorithm>
#include <cmath>
#include <limits>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

/// Steps of a program in one push: each takes the rows of the held points anew.
constexpr int kStepsPerPush = 2;
/// Fewer points than this do not begin a program: its solution would follow their noise.
constexpr std::uint32_t kLeastFitted = 12;
/// A smallest feasible tolerance above the wanted one by no more than this share meets it.
constexpr double kFeasible = 1e-9;
/// Points looked at for the first ones of a program.
constexpr std::uint32_t kSeedsLookedAt = 512;
/// A pose that moves by less than this [half diagonals] does not make what was looked at before uncertain.
constexpr double kStill = 1e-7;

}  // namespace

/// w of a foot: its tolerance [mm] in a constrained fit, 1 at the leading edge and the ratio elsewhere in
/// min_tolerance. 0: its distance has no bound.
double Localizer::bound_weight(const Foot& foot) const {
  if (config_.mode == FitMode::constrained) {
    const double tolerance = tolerance_at(config_.tolerance, foot.patch, foot.u, foot.v);
    return std::isfinite(tolerance) ? tolerance : 0.0;
  }
  ToleranceMap weights = config_.tolerance;
  weights.leading_edge_mm = 1.0;
  weights.rest_mm = config_.ratio;
  return tolerance_at(weights, foot.patch, foot.u, foot.v);
}

/// What a value of the programs is a multiple of [mm].
double Localizer::bound_unit() const {
  if (config_.mode != FitMode::constrained) return 1.0;
  const ToleranceMap& tolerance = config_.tolerance;
  return std::isfinite(tolerance.leading_edge_mm) ? tolerance.leading_edge_mm : tolerance.rest_mm;
}

void Localizer::stop_trackers() {
  tracker_.stop();
  least_.stop();
}

/// Middle of the signed distances that a range lies about; 0 in the other modes.
double Localizer::middle_distance(std::uint32_t stride) const {
  if (config_.mode != FitMode::range) return 0.0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::uint32_t i = 0; i < stored_; i += stride) {
    if (left_out(points_[i], points_[i].foot)) continue;
    least = std::min(least, points_[i].foot.distance);
    most = std::max(most, points_[i].foot.distance);
  }
  return least <= most ? 0.5 * (least + most) : 0.0;
}

/// The programs begin at the present pose with the most outlying of every `stride`-th point.
void Localizer::begin_trackers(std::uint32_t stride) {
  tracker_.begin(config_.mode, pose_, reach());
  if (config_.mode == FitMode::constrained) least_.begin(FitMode::min_tolerance, pose_, reach());
  looked_at_ = 0;
  std::array<double, BoundTracker::kPlaces> ratio{};
  std::array<std::uint32_t, BoundTracker::kPlaces> index{};
  std::uint32_t count = 0;
  const bool plain = config_.mode == FitMode::minimax || config_.mode == FitMode::range;
  const double middle = middle_distance(stride);
  for (std::uint32_t i = 0; i < stored_; i += stride) {
    const Foot& foot = points_[i].foot;
    const double weight = plain ? 1.0 : bound_weight(foot);
    if (left_out(points_[i], foot) || weight == 0.0) continue;
    const double size = std::abs(foot.distance - middle) / weight;
    if (count == BoundTracker::kPlaces && size <= ratio[count - 1]) continue;
    std::uint32_t place = count < BoundTracker::kPlaces ? count++ : count - 1;
    for (; place > 0 && ratio[place - 1] < size; --place) {
      ratio[place] = ratio[place - 1];
      index[place] = index[place - 1];
    }
    ratio[place] = size;
    index[place] = i;
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    tracker_.hold(index[k]);
    if (least_.active()) least_.hold(index[k]);
  }
}

/// A stored point was projected anew: one that does not fit into a present solution is held.
void Localizer::look_at(std::uint32_t index, const Measurement& m) {
  if (!tracker_.active() || left_out(points_[index], m.foot)) return;
  const double weight = bound_weight(m.foot);
  bool violated = weight > 0.0 && tracker_.violated(m.foot.distance, weight) && !tracker_.holds(index);
  if (violated) tracker_.hold(index);
  if (least_.active() && !least_.holds(index)) {
    const Foot foot = measure(points_[index], least_.pose(), Search::past_lead).foot;
    const double bound = bound_weight(foot);
    if (bound > 0.0 && least_.violated(foot.distance, bound)) {
      least_.hold(index);
      violated = true;
    }
  }
  looked_at_ = violated ? 0 : std::min(looked_at_ + 1, stored_);
}

/// Steps of a program until it rests, two at most. False: it has no solution.
bool Localizer::follow(BoundTracker& tracker) {
  if (tracker.count() < std::min(BoundTracker::kPlaces, current_.model.count)) return true;
  for (int k = 0; k < kStepsPerPush && tracker.unsettled(); ++k) {
    const Pose pose = tracker.pose();
    const MotionBasis basis = free_motions(pose, config_.locked, frame_);
    for (std::uint32_t place = 0; place < tracker.count(); ++place) {
      const StoredPoint& point = points_[tracker.point(place)];
      const Measurement m = measure(point, pose, Search::past_lead);
      const double weight = bound_weight(m.foot);
      if (left_out(point, m.foot) || weight == 0.0) {
        tracker.skip_row(place);
      } else {
        tracker.set_row(place, row_of(m, Vec6::Zero()), weight, basis);
      }
    }
    if (!tracker.step(shifted(current_.model, pose, frame_), frame_, config_.start, config_.locked)) return false;
    if (motion_between(pose, tracker.pose(), frame_).norm() > kStill * frame_.length) looked_at_ = 0;
  }
  return true;
}

/// The mode's program after a new point. The pose becomes its solution; where no pose meets the tolerances of a
/// constrained fit, that with the smallest feasible ones.
void Localizer::follow_bounds() {
  if (config_.mode == FitMode::least_squares) return;
  if (determination_.rank < 6) stop_trackers();
  if (!tracker_.active()) {
    tolerance_factor_ = smallest_tolerance_ = 0.0;
    certificate_ = Certificate();
    if (determination_.rank < 6 || current_.model.count < kLeastFitted) return;
    begin_trackers(1 + stored_ / kSeedsLookedAt);
  }
  if (least_.active()) {
    (void)follow(least_);
    infeasible_ = !least_.unsettled() && least_.value() > 1.0 + kFeasible;
    tracker_.disturb();
  }
  // Where the tolerances cannot be met to first order from here, they can from where they are met best.
  if (!infeasible_ && !follow(tracker_) && least_.active()) tracker_.go_to(least_.pose());
  const Pose& pose = infeasible_ ? least_.pose() : tracker_.pose();
  if (motion_between(pose_, pose, frame_).norm() > 0.0) ++revision_;
  pose_ = pose;
  tell_bounds();
}

/// Value and certificate of the present solution, which refine() makes exact.
void Localizer::tell_bounds() {
  const BoundTracker& told = least_.active() ? least_ : tracker_;
  const double value = told.value() * bound_unit();
  const bool optimum = config_.mode != FitMode::constrained || infeasible_;
  tolerance_factor_ = optimum ? value : 0.0;
  if (told.mode() == FitMode::min_tolerance) smallest_tolerance_ = value;
  certificate_ = optimum && config_.mode != FitMode::range ? told.certificate() : Certificate();
  name_points(certificate_);
}

/// Point numbers become sequence numbers, multipliers those of tolerances in mm.
void Localizer::name_points(Certificate& certificate) const {
  for (std::uint32_t k = 0; k < certificate.count; ++k) {
    certificate.multiplier[k] *= bound_unit();
    certificate.sequence[k] = points_[certificate.sequence[k]].sequence;
  }
}

bool Localizer::improving() const {
  if (config_.mode == FitMode::least_squares || converged_) return false;
  const bool constrained = config_.mode == FitMode::constrained;
  const BoundTracker& program = constrained ? least_ : tracker_;
  return !program.active() || program.unsettled() || looked_at_ < stored_;
}

}  // namespace bladefit
