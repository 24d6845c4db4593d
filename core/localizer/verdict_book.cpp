#include "core/localizer/verdict_book.hpp"

#include <cmath>

namespace bladefit {

void VerdictBook::attach(std::uint32_t* ring, std::uint32_t capacity) {
  ring_ = ring;
  capacity_ = capacity;
}

void VerdictBook::clear() {
  head_ = size_ = rejected_ = 0;
  out_ = {};
}

void VerdictBook::count(const StoredPoint& point, int sign) {
  const auto one = static_cast<std::uint32_t>(sign);
  if (point.state == PointState::out) out_[static_cast<std::size_t>(point.region)] += one;
  if (point.state == PointState::rejected) rejected_ += one;
}

/// Region, zone and tolerance of a point follow its foot.
void VerdictBook::follow_foot(StoredPoint& point) const {
  const MapPart part = problem_.part_of(point.foot);
  point.region = part.region;
  point.zone = part.zone;
  point.tolerance = problem_.tolerance_of(point.foot, part);
}

void VerdictBook::assign_region(StoredPoint& point) {
  count(point, -1);
  follow_foot(point);
  count(point, +1);
}

/// What the foot says of the point. Beyond an outer edge the design holds no surface: neither cut nor weld is proven
/// there, far beyond it not even that the blade is longer than the design, and what lies between two outer edges that
/// face each other, as on a blunt trailing edge, is not beyond. A point that counts in the fit is judged by its
/// distance like any other.
VerdictBook::Finding VerdictBook::finding_of(const StoredPoint& point) const {
  const Foot& foot = point.foot;
  const double touching = tuning::kTouchingBound * problem_.frame.length, bound = point.tolerance + touching;
  const Limits allowed = problem_.limits_of(point.zone, point.tolerance);
  const auto judged_by = [&](const Limits& limits, double distance) {
    return decide(problem_.config.decision.rule, {distance, limits, point.uncertainty, point.expanded, touching});
  };
  const auto judged = [&](double distance) { return judged_by(allowed, distance); };
  const auto with_action = [&](PointState state) {
    const Action by_sign = foot.distance > 0.0 ? Action::cut : Action::weld;
    return Finding{state, state == PointState::out ? by_sign : Action::none};
  };
  if (point.outside_window) return {PointState::rejected, Action::none, LeftOut::window};
  if (foot.border == FootBorder::none || foot.border == FootBorder::joint) return with_action(judged(foot.distance));
  const bool far = foot.beyond > tuning::kFarBeyond * problem_.frame.length;
  if (foot.beyond > allowed.nearer() + touching) {
    // Neither side is that of what lies beyond: between the two limits it is not known which one holds.
    const bool between = foot.beyond <= allowed.farther() + touching;
    if (far || between) return {PointState::undecided};
    return {judged_by(Limits::both(allowed.farther()), foot.beyond)};
  }
  // What is left of the distance at the end of a joint leads away from that.
  const double aside = std::sqrt(std::max(0.0, foot.distance * foot.distance - foot.beyond * foot.beyond));
  if (foot.border == FootBorder::joint_end && aside > bound)
    return with_action(judged(std::copysign(aside, foot.distance)));
  if (!point.fitted) return {PointState::rejected, Action::none, LeftOut::edge};
  return {judged(foot.distance)};
}

void VerdictBook::judge(StoredPoint& point, const Evidence& evidence) {
  if (point.tolerance != 0.0) count(point, -1);
  if (!selection_.held()) follow_foot(point);
  assess(point, evidence);
  count(point, +1);
}

void VerdictBook::judge_aside(StoredPoint& point, const Evidence& evidence) const {
  follow_foot(point);
  assess(point, evidence);
}

/// State, action and uncertainty of a point whose region and tolerance are known.
void VerdictBook::assess(StoredPoint& point, const Evidence& evidence) const {
  const Foot& foot = point.foot;
  const Limits allowed = problem_.limits_of(point.zone, point.tolerance);
  point.tolerance = allowed.of(foot.distance);  // while regions are held the distance may have changed its side
  const PoseEstimate::DistanceUncertainty uncertainty = evidence.estimate.uncertainty_of(point.position, foot);
  point.uncertainty = uncertainty.standard;
  const double length = (apply(evidence.estimate.pose(), point.position) - problem_.frame.pivot).norm();
  point.expanded = problem_.config.decision.expanded(uncertainty.standard, length);
  point.fitted = !selection_.left_out(point, foot);
  const double pending_above =
      tuning::kPendingShare * (std::isfinite(allowed.nearer()) ? allowed.nearer() : problem_.config.determined_mm);
  Finding finding = finding_of(point);
  if (finding.state != PointState::rejected) {
    if (!evidence.settled && is_judged(point.state)) return;
    const bool open = uncertainty.undetermined > pending_above || !evidence.enough || !evidence.settled;
    if (open) finding = {PointState::pending};
  }
  point.state = finding.state;
  point.action = finding.action;
  point.left_out = finding.left_out;
}

void VerdictBook::judge_new(StoredPoint& point, const Evidence& evidence) {
  judge(point, evidence);
  point.reported_state = point.state;
  point.reported_action = point.action;
}

void VerdictBook::judge_again(PointStore& store, std::uint32_t index, const Evidence& evidence) {
  StoredPoint& point = store[index];
  judge(point, evidence);
  if (point.queued || (point.state == point.reported_state && point.action == point.reported_action)) return;
  point.queued = true;
  ring_[(head_ + size_) % capacity_] = index;
  ++size_;
}

bool VerdictBook::next_revision(PointStore& store, Verdict& verdict) {
  while (size_ > 0) {
    StoredPoint& point = store[ring_[head_]];
    head_ = (head_ + 1) % capacity_;
    --size_;
    point.queued = false;
    if (point.state == point.reported_state && point.action == point.reported_action) continue;  // changed back
    point.reported_state = point.state;
    point.reported_action = point.action;
    verdict = verdict_of(point);
    return true;
  }
  return false;
}

Verdict verdict_of(const StoredPoint& point) {
  Verdict verdict;
  verdict.sequence = point.sequence;
  verdict.foot = point.foot;
  verdict.region = point.region;
  verdict.zone = point.zone;
  verdict.tolerance_mm = point.tolerance;
  verdict.uncertainty_mm = point.uncertainty;
  verdict.expanded_mm = point.expanded;
  verdict.state = point.state;
  verdict.action = point.action;
  verdict.left_out = point.left_out;
  verdict.fitted = point.fitted;
  verdict.revision = point.revision;
  return verdict;
}

}  // namespace bladefit
