#include "core/programs/bound_tracker.hpp"

#include <algorithm>

namespace bladefit {
namespace {

/// Beyond its bound by this share of it, or of the reach, is a violation.
constexpr double kBeyond = 1e-9, kBeyondReach = 1e-12;

}  // namespace

void BoundTracker::begin(FitMode mode, const Pose& pose, double reach) {
  fit_.attach(memory_.data(), kPlaces);
  fit_.begin(mode, 0, reach);
  pose_ = last_pose_ = pose;
  reach_ = reach;
  count_ = 0;
  active_ = unsettled_ = true;
  stepped_ = false;
  value_ = least_ = most_ = 0;
}

bool BoundTracker::holds(std::uint32_t point) const {
  return std::find(points_.begin(), points_.begin() + count_, point) != points_.begin() + count_;
}

bool BoundTracker::violated(double d, const Limits& w) const {
  if (!stepped_) return count_ < kPlaces;
  const double margin = kBeyondReach * reach_;
  const BoundRows::Extremes allowed = fit_.allowed(w, value_, {least_, most_}, kBeyond);
  return d > allowed.most + margin || d < allowed.least - margin;
}

/// The place with the most slack that the solution does not rest on.
std::uint32_t BoundTracker::place_to_release() const {
  const ActiveRows active = fit_.active_rows();
  std::uint32_t best = 0;
  double most_slack = -1.0;
  for (std::uint32_t k = 0; k < count_; ++k) {
    const auto* end = active.index.begin() + active.count;
    if (std::find(active.index.begin(), end, k) != end) continue;
    const double slack = fit_.slack(k);
    if (slack <= most_slack) continue;
    most_slack = slack;
    best = k;
  }
  return best;
}

void BoundTracker::hold(std::uint32_t point) {
  const std::uint32_t place = count_ < kPlaces ? count_++ : place_to_release();
  points_[place] = point;
  fit_.skip_row(place);
  disturb();
}

void BoundTracker::disturb() {
  fit_.resume(count_);
  unsettled_ = true;
}

void BoundTracker::go_to(const Pose& pose) {
  pose_ = pose;
  disturb();
}

void BoundTracker::set_row(std::uint32_t place, const DistanceRow& row, const Limits& weight,
                           const MotionBasis& basis) {
  fit_.set_basis(basis);
  (void)fit_.set_weight(place, weight);
  fit_.set_row(place, row);
}

void BoundTracker::skip_row(std::uint32_t place) { fit_.skip_row(place); }

bool BoundTracker::step(const QuadraticModel& model, const MotionFrame& frame, const Pose& start, std::uint8_t locked) {
  value_ = fit_.value();
  stepped_ = true;
  const BoundRows::Extremes extremes = fit_.extremes();
  least_ = extremes.least;
  most_ = extremes.most;
  const BoundedFit::Step step = fit_.step(model);
  if (!succeeded(step.status)) return false;
  unsettled_ = !step.settled;
  if (step.settled) return true;
  if (!step.from_last) last_pose_ = pose_;
  pose_ = held(moved(last_pose_, step.x, frame), start, locked);
  return true;
}

ActiveRows BoundTracker::active_rows() const {
  ActiveRows out = fit_.active_rows();
  for (std::uint32_t k = 0; k < out.count; ++k) out.index[k] = points_[out.index[k]];
  return out;
}

}  // namespace bladefit
