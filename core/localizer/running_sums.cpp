#include "core/localizer/running_sums.hpp"

#include <utility>

namespace bladefit {

void RunningSums::clear(const Pose& pose) {
  evicted_ = FitSums();
  evicted_.model.reference = pose;
  recent_count_ = active_count_ = 0;
  begin_sweep(pose);
  committed_ = current_ = next_;
}

double RunningSums::moved_to(const Pose& pose) const {
  return motion_between(committed_.model.reference, pose, problem_.frame).norm();
}

bool RunningSums::contested(const StoredPoint& point) const {
  return point.runner_up.margin < tuning::kContestedMargin * problem_.frame.length;
}

void RunningSums::add(FitSums& sums, const StoredPoint& point, const Measurement& m, const Vec6& x) const {
  if (!selection_.left_out(point, m.foot)) add_row(sums, point, m, finder_.row(m, x), x);
}

void RunningSums::add_at(FitSums& sums, const StoredPoint& point, const Measurement& m, const Pose& pose) const {
  add(sums, point, m, motion_between(sums.model.reference, pose, problem_.frame));
}

void RunningSums::add_row(FitSums& sums, const StoredPoint& point, const Measurement& m, const DistanceRow& row,
                          const Vec6& x) const {
  sums.model.add(row, x, point.weight, loss_.terms(m.foot.distance));
  add_to_region(sums, point, m.foot);
}

void RunningSums::add_to_region(FitSums& sums, const StoredPoint& point, const Foot& foot) const {
  const Region region = selection_.region(point, foot);
  sums.regions[static_cast<std::size_t>(region)].add(foot.distance, point.sequence);
}

void RunningSums::take_in(PointStore& store, std::uint32_t index, const PoseEstimate& estimate) {
  if (recent_count_ == tuning::kRecentPlaces) settle_one(store, 0, estimate);
  make_recent(store[index], index);
  // The new one is active at once; those that join at the end of the sweep stay behind it.
  std::swap(recent_[recent_count_ - 1], recent_[active_count_]);
  ++active_count_;
}

void RunningSums::take_in_passing(const StoredPoint& point, const Measurement& m, const Pose& pose) {
  for (FitSums* sums : {&committed_, &next_, &evicted_}) add_at(*sums, point, m, pose);
}

void RunningSums::evict(const StoredPoint& point, std::uint32_t index, const Pose& pose) {
  const Measurement m = finder_.find(point, pose, Search::past_margin);
  add_at(evicted_, point, m, pose);
  if (index >= cursor_) add_at(next_, point, m, pose);
}

void RunningSums::take_in_staged(const StoredPoint& point, const Measurement& m, const Pose& pose) {
  add_at(committed_, point, m, pose);
  current_ = committed_;
}

void RunningSums::make_recent(StoredPoint& point, std::uint32_t index) {
  point.recent = true;
  recent_[recent_count_++] = index;
}

/// Gives the row of an active recent point to the sums that last until the end of the next sweep.
void RunningSums::settle_one(PointStore& store, std::uint32_t place, const PoseEstimate& estimate) {
  const std::uint32_t index = recent_[place];
  StoredPoint& point = store[index];
  for (std::uint32_t k = place; k + 1 < recent_count_; ++k) recent_[k] = recent_[k + 1];
  --recent_count_;
  --active_count_;
  point.recent = false;
  const Measurement m = finder_.find(point, estimate.pose(), Search::past_margin);
  store.record(point, m, estimate.revision());
  add_at(committed_, point, m, estimate.pose());
  if (index < cursor_) add_at(next_, point, m, estimate.pose());
}

void RunningSums::settle(PointStore& store, const PoseEstimate& estimate) {
  std::uint32_t calm = 0;
  for (std::uint32_t k = active_count_; k-- > 0;) {
    if (!contested(store[recent_[k]]) && ++calm > tuning::kNewestRecent) settle_one(store, k, estimate);
  }
}

void RunningSums::settle_all(PointStore& store, const PoseEstimate& estimate) {
  if (recent_count_ == 0) return;  // those in use are the committed ones already
  while (active_count_ > 0) settle_one(store, active_count_ - 1, estimate);
  for (std::uint32_t k = 0; k < recent_count_; ++k) store[recent_[k]].recent = false;
  recent_count_ = 0;
  current_ = committed_;
}

void RunningSums::begin_sweep(const Pose& pose) {
  swept_.clear();
  next_ = evicted_;
  next_.model = shifted(evicted_.model, pose, problem_.frame);
  cursor_ = 0;
}

void RunningSums::sweep_over(const StoredPoint& point, const Measurement& m, const DistanceRow& row) {
  swept_.add(cursor_ % kLanes, row, point.weight, loss_.terms(m.foot.distance));
  add_to_region(next_, point, m.foot);
  ++cursor_;
}

void RunningSums::sweep_in_block(const StoredPoint& point) {
  swept_.count_in_block(cursor_ % kLanes, point.weight, loss_.terms(point.foot.distance));
  add_to_region(next_, point, point.foot);
  ++cursor_;
}

void RunningSums::commit() {
  swept_.move_to(next_.model);
  committed_ = current_ = next_;
}

}  // namespace bladefit
