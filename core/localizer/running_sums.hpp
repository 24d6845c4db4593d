#pragma once
#include <array>

#include "core/fit/swept_rows.hpp"
#include "core/localizer/fit_sums.hpp"
#include "core/localizer/foot_finder.hpp"
#include "core/localizer/pose_estimate.hpp"

namespace bladefit {

/// The sums that the pose is solved from. Those in use hold every point once: the rows of recent points are taken again
/// in every push, those of the others stay until a sweep over the stored points has filled the next set. Nothing is
/// ever subtracted.
class RunningSums {
 public:
  RunningSums(const FitProblem& problem, const PointSelection& selection, const LossSchedule& loss,
              const FootFinder& finder)
      : problem_(problem), selection_(selection), loss_(loss), finder_(finder) {}

  /// Forgets all points.
  void clear(const Pose& pose);

  /// The sum in use, and its figures of a region.
  [[nodiscard]] const QuadraticModel& model() const { return current_.model; }
  [[nodiscard]] const RegionSums& region(Region r) const { return current_.regions[static_cast<std::size_t>(r)]; }
  /// The pose has moved so far since the sums in use were begun [mm at the half diagonal].
  [[nodiscard]] double moved_to(const Pose& pose) const;
  /// A point is contested while another local minimum is hardly farther than its foot.
  [[nodiscard]] bool contested(const StoredPoint& point) const;

  // Points that come
  /// A point that has just been stored becomes recent.
  void take_in(PointStore& store, std::uint32_t index, const PoseEstimate& estimate);
  /// A point that found no place: its row stays in all sums as it is.
  void take_in_passing(const StoredPoint& point, const Measurement& m, const Pose& pose);
  /// A stored point that loses its place: the same. Cost: one projection.
  void evict(const StoredPoint& point, std::uint32_t index, const Pose& pose);
  /// A point that was stored without moving the pose.
  void take_in_staged(const StoredPoint& point, const Measurement& m, const Pose& pose);

  // A push
  /// Recent points that are neither contested nor among the newest few join the others.
  void settle(PointStore& store, const PoseEstimate& estimate);
  /// Projects up to `budget` more points of the sweep again, telling `review(index, measurement)` of each. True where
  /// that ended the sweep: then the next sums are in use.
  template <class Review>
  bool refresh(PointStore& store, const PoseEstimate& estimate, std::uint32_t budget, Review review);
  /// Adds the rows of the recent points at the present pose to the committed ones. That of the newest one is known.
  template <class Review>
  void gather(PointStore& store, const Pose& pose, std::uint32_t newest_sequence, const Measurement& newest,
              Review review);

  // A sweep of refine()
  /// Every point joins the others: sweeps go over all of them.
  void settle_all(PointStore& store, const PoseEstimate& estimate);
  void begin_sweep(const Pose& pose);
  /// Index of the sweep's next point.
  [[nodiscard]] std::uint32_t cursor() const { return cursor_; }
  /// The sweep's next point, which counts, with its row at the pose that the sweep began at.
  void sweep_over(const StoredPoint& point, const Measurement& m, const DistanceRow& row);
  /// The same, where its row is in the lane of a block that end_block() is given. The foot was recorded.
  void sweep_in_block(const StoredPoint& point);
  /// Whether the row of the sweep's next point, which is in this lane, can be taken from there.
  [[nodiscard]] bool in_block(std::uint32_t lane) const { return lane == cursor_ % kLanes; }
  void end_block(const LaneBlock& block) { swept_.add_block(block.rows); }
  /// The sweep's next point does not count.
  void pass_over() { ++cursor_; }
  /// At the end of the sweep: the next sums are in use.
  void commit();

 private:
  void add(FitSums& sums, const StoredPoint& point, const Measurement& m, const Vec6& x) const;
  void add_at(FitSums& sums, const StoredPoint& point, const Measurement& m, const Pose& pose) const;
  void add_row(FitSums& sums, const StoredPoint& point, const Measurement& m, const DistanceRow& row,
               const Vec6& x) const;
  void add_to_region(FitSums& sums, const StoredPoint& point, const Foot& foot) const;
  void make_recent(StoredPoint& point, std::uint32_t index);
  void settle_one(PointStore& store, std::uint32_t place, const PoseEstimate& estimate);

  const FitProblem& problem_;
  const PointSelection& selection_;
  const LossSchedule& loss_;
  const FootFinder& finder_;
  FitSums committed_;  ///< all points but the active recent ones
  FitSums current_;    ///< those and the recent ones
  FitSums next_;       ///< by the sweep under way; takes the place of committed_ at its end
  SweptRows swept_;    ///< rows of it that are not in next_ yet
  FitSums evicted_;    ///< points that have no place in memory
  std::uint32_t cursor_ = 0;
  /// Indices of the recent points. The first active_count_ are outside of committed_, the others leave it at the
  /// sweep's end.
  std::array<std::uint32_t, tuning::kRecentPlaces> recent_{};
  std::uint32_t recent_count_ = 0, active_count_ = 0;
};

template <class Review>
bool RunningSums::refresh(PointStore& store, const PoseEstimate& estimate, std::uint32_t budget, Review review) {
  swept_.move_to(next_.model);  // a refinement was cut short
  const Vec6 x = motion_between(next_.model.reference, estimate.pose(), problem_.frame);
  const std::uint32_t end = cursor_ + std::min(budget, store.size() - cursor_);
  while (cursor_ < end) {
    std::array<std::uint32_t, kLanes> indices{};
    std::uint32_t count = 0;
    for (; cursor_ < end && count < kLanes; ++cursor_) {
      if (!store[cursor_].recent) indices[count++] = cursor_;
    }
    finder_.find_each(
        store, {indices.data(), count}, estimate.pose(), x,
        [&](std::uint32_t index) {
          return FootStart{place_of(store[index]), Search::past_margin};
        },
        [&](std::uint32_t index, const Measurement& m) {
          review(index, m);
          if (contested(store[index]) && recent_count_ + tuning::kNewestRecent < tuning::kRecentPlaces) {
            make_recent(store[index], index);  // its old row is in the sums in use until the sweep's end
          } else {
            add(next_, store[index], m, x);
          }
        });
  }
  if (cursor_ < store.size()) return false;
  committed_ = next_;
  active_count_ = recent_count_;
  begin_sweep(estimate.pose());
  return true;
}

template <class Review>
void RunningSums::gather(PointStore& store, const Pose& pose, std::uint32_t newest_sequence, const Measurement& newest,
                         Review review) {
  current_ = committed_;
  const Vec6 x = motion_between(current_.model.reference, pose, problem_.frame);
  const auto each = [&](std::uint32_t first, std::uint32_t end) {
    finder_.find_each(
        store, {recent_.data() + first, end - first}, pose, x,
        [&](std::uint32_t index) {
          return FootStart{place_of(store[index]), Search::past_margin};
        },
        [&](std::uint32_t index, const Measurement& m) {
          review(index, m);
          add(current_, store[index], m, x);
        });
  };
  std::uint32_t place = 0;
  while (place < active_count_ && store[recent_[place]].sequence != newest_sequence) ++place;
  each(0, place);
  if (place == active_count_) return;
  add(current_, store[recent_[place]], newest, x);
  each(place + 1, active_count_);
}

}  // namespace bladefit
