#include "core/localizer/sweep.hpp"

#include <cmath>
#include <limits>

namespace bladefit {

void Sweep::restart(const Pose& pose) {
  thorough_ = next_proves_ = false;
  number_ = changed_ = unproven_ = 0;
  last_pose_ = Pose();
  last_step_.setZero();
  rows_pose_ = pose;
  travelled_ = 0;
  since_search_ = std::numeric_limits<double>::infinity();
}

void Sweep::begin(const Pose& pose) {
  ++number_;
  travelled_ = motion_between(rows_pose_, pose, problem_.frame).norm();
  since_search_ += travelled_;
  rows_pose_ = pose;
}

bool Sweep::proven_already() const { return since_search_ <= tuning::kSearchHolds * problem_.frame.length; }

/// Points that were staged from a place are tracked until the last sweep: their margin is infinite.
Search Sweep::search_of(const StoredPoint& point) const {
  if (thorough_) return proven_already() ? Search::if_doubtful : Search::always;
  if (number_ > tuning::kFreeSearchSweeps) return Search::keep;
  const bool travels =
      travelled_ > tuning::kTravelsBeyond * problem_.frame.length && std::isfinite(point.runner_up.margin);
  return travels ? Search::always : Search::if_doubtful;
}

void Sweep::count(const Measurement& m) {
  if (m.changed) ++changed_;
  if (!m.proven) ++unproven_;
}

void Sweep::end() {
  if (unproven_ > 0) {
    since_search_ = std::numeric_limits<double>::infinity();
  } else if (thorough_ && !proven_already()) {
    since_search_ = 0.0;
  }
  thorough_ = next_proves_;
  next_proves_ = false;
  changed_ = unproven_ = 0;
}

void Sweep::begin_again() {
  last_step_.setConstant(problem_.frame.length);
  number_ = 0;
  next_proves_ = false;
}

bool Sweep::last_step_counts() const { return last_step_.norm() > tuning::kCheckedAbove * problem_.frame.length; }

}  // namespace bladefit
