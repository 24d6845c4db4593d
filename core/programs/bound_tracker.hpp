#pragma once
#include <array>

#include "core/programs/bounded_fit.hpp"

namespace bladefit {

/// An optimum of single distances followed through a stream. A problem of few unknowns has few points that matter: some
/// two dozen of the most outlying ones are held, the program is solved on these, and every other point is looked at now
/// and then. One that does not violate the solution changes nothing; one that does takes the place of the point with
/// the most slack, and the program starts from its present active set (Clarkson 1995, for points that come one by one).
class BoundTracker {
 public:
  BoundTracker() = default;
  BoundTracker(const BoundTracker&) = delete;  ///< its program points into its memory
  BoundTracker& operator=(const BoundTracker&) = delete;
  static constexpr std::uint32_t kPlaces = 24;

  /// Begins at `pose` with no point. `reach` [mm]: no step is longer.
  void begin(FitMode mode, const Pose& pose, double reach);
  void stop() {
    active_ = false;
    count_ = 0;
  }
  [[nodiscard]] bool active() const { return active_; }
  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] FitMode mode() const { return fit_.mode(); }

  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// Number of the point in a place, as it was given to hold().
  [[nodiscard]] std::uint32_t point(std::uint32_t place) const { return points_[place]; }
  [[nodiscard]] bool holds(std::uint32_t point) const;

  /// A distance `d` [mm] of weight `w` on either side at this pose does not fit into the present solution. Before the
  /// first step every distance does that finds a place.
  [[nodiscard]] bool violated(double d, const Limits& w) const;
  /// Takes a point in. Cost: one pass over the places.
  void hold(std::uint32_t point);
  /// The rows must be taken again, at pose(), before the next step.
  [[nodiscard]] bool unsettled() const { return unsettled_; }
  void set_row(std::uint32_t place, const DistanceRow& row, const Limits& weight, const MotionBasis& basis);
  /// The point does not count.
  void skip_row(std::uint32_t place);
  /// One step of the program on the rows; `model`: sum of 1/2 d^2 about pose(). False: the program has no solution.
  [[nodiscard]] bool step(const QuadraticModel& model, const MotionFrame& frame, const Pose& start,
                          std::uint8_t locked);
  /// The objective has changed, as that of a constrained optimum does with every point.
  void disturb();
  /// Goes on from another pose.
  void go_to(const Pose& pose);

  /// Of the held points at the rows last set: as BoundedFit::value().
  [[nodiscard]] double value() const { return value_; }
  /// What the present solution rests on, by the numbers given to hold().
  [[nodiscard]] ActiveRows active_rows() const;

 private:
  [[nodiscard]] std::uint32_t place_to_release() const;

  BoundedFit fit_;
  std::array<double, BoundRows::doubles_for(kPlaces)> memory_{};
  std::array<std::uint32_t, kPlaces> points_{};
  std::uint32_t count_ = 0;
  Pose pose_;
  Pose last_pose_;
  double reach_ = 0;
  bool active_ = false, unsettled_ = false, stepped_ = false;
  double value_ = 0, least_ = 0, most_ = 0;
};

}  // namespace bladefit
