#pragma once
#include "core/localizer/foot_finder.hpp"

namespace bladefit {

/// What is known of the sweeps of a refinement: how the pose travels, and which feet are proven.
class Sweep {
 public:
  explicit Sweep(const FitProblem& problem) : problem_(problem) {}

  /// Before the first sweep, at this pose.
  void restart(const Pose& pose);
  /// A sweep begins at this pose.
  void begin(const Pose& pose);
  /// How the foot of a point is to be found in this sweep.
  [[nodiscard]] Search search_of(const StoredPoint& point) const;
  void count(const Measurement& m);
  /// The sweep is over, after whose feet the pose was moved by last_step().
  void end();

  /// Every foot of this sweep was proven, and none was another than before.
  [[nodiscard]] bool proves() const { return thorough_ && changed_ == 0; }
  /// It is to prove every foot.
  [[nodiscard]] bool proof() const { return thorough_; }
  /// The same while points keep their sheets.
  [[nodiscard]] Search search_of_kept() const { return thorough_ && !proven_already() ? Search::always : Search::keep; }
  /// The next sweep is to prove every foot.
  void prove_next() { next_proves_ = true; }
  /// Feet of this sweep whose search met its cap.
  [[nodiscard]] std::uint32_t unproven() const { return unproven_; }
  /// Sweeps since the programs or the sums were begun, this one included.
  [[nodiscard]] std::uint32_t number() const { return number_; }
  /// Programs or sums begin again: the next sweep takes rows, and no step is compared with those before.
  void begin_again();

  /// The last step of the pose, and where it was made from.
  [[nodiscard]] const Vec6& last_step() const { return last_step_; }
  [[nodiscard]] const Pose& last_pose() const { return last_pose_; }
  void set_last_step(const Vec6& step) { last_step_ = step; }
  void set_last_pose(const Pose& pose) { last_pose_ = pose; }
  /// Longer than a step that may raise the sum of squares by rounding.
  [[nodiscard]] bool last_step_counts() const;

 private:
  /// A sweep before this one has searched every foot, and the pose has hardly moved since.
  [[nodiscard]] bool proven_already() const;

  const FitProblem& problem_;
  bool next_proves_ = false;
  bool thorough_ = false;  ///< every foot of this sweep is to be proven
  std::uint32_t number_ = 0, changed_ = 0, unproven_ = 0;
  Pose last_pose_;
  Vec6 last_step_ = Vec6::Zero();
  Pose rows_pose_;           ///< of the sweep before
  double travelled_ = 0;     ///< from there to that of this sweep [mm at the half diagonal]
  double since_search_ = 0;  ///< the same since the last sweep that searched every foot and proved each
};

}  // namespace bladefit
