#pragma once
#include "core/localizer/mode_plan.hpp"
#include "core/localizer/running_sums.hpp"
#include "core/programs/bound_tracker.hpp"

namespace bladefit {

/// The mode's optimum followed point by point: the program over a working set of points, and where the bounds may be
/// infeasible also that of the smallest feasible ones.
class StreamOptimum {
 public:
  StreamOptimum(const FitProblem& problem, const ModePlan& plan, const FootFinder& finder,
                const PointSelection& selection)
      : problem_(problem), plan_(plan), finder_(finder), selection_(selection) {}

  void stop();
  /// Whether the pose is that of the program.
  [[nodiscard]] bool leads() const { return program_.active(); }
  [[nodiscard]] bool holds(std::uint32_t index) const { return program_.holds(index) || feasibility_.holds(index); }

  /// Begins at `pose` with the most outlying of every `stride`-th point. Cost: linear.
  void begin(const PointStore& store, const Pose& pose, std::uint32_t stride);
  /// A stored point was measured again: one that violates a present solution joins its working set.
  void look_at(const PointStore& store, std::uint32_t index, const Measurement& m);
  /// A few steps of the programs after a new point. They begin when the pose is determined by enough points.
  void follow(const PointStore& store, const QuadraticModel& model, const PoseEstimate& estimate, ModeOptimum& optimum);
  /// Pose of the solution, where there is a program; where no pose meets the tolerances, that of the smallest feasible
  /// ones.
  [[nodiscard]] const Pose& pose(const ModeOptimum& optimum) const {
    return optimum.infeasible ? feasibility_.pose() : program_.pose();
  }
  /// The optimum still moves, or not every point has been looked at since it did.
  [[nodiscard]] bool improving(const PointStore& store) const;

 private:
  /// A few points ordered by how far out they are, the farthest first.
  struct Seeds {
    std::array<double, BoundTracker::kPlaces> size{};
    std::array<std::uint32_t, BoundTracker::kPlaces> index{};
    std::uint32_t count = 0;
    void offer(std::uint32_t i, double how_far);
  };
  [[nodiscard]] double middle_distance(const PointStore& store, std::uint32_t stride) const;
  [[nodiscard]] Seeds seeds(const PointStore& store, std::uint32_t stride) const;
  [[nodiscard]] bool follow(BoundTracker& tracker, const PointStore& store, const QuadraticModel& model);
  void set_rows(BoundTracker& tracker, const PointStore& store) const;
  /// The program that values are taken from.
  [[nodiscard]] const BoundTracker& telling() const { return feasibility_.active() ? feasibility_ : program_; }

  const FitProblem& problem_;
  const ModePlan& plan_;
  const FootFinder& finder_;
  const PointSelection& selection_;
  BoundTracker program_, feasibility_;
  std::uint32_t looked_at_ = 0;  ///< points since the programs last moved
};

}  // namespace bladefit
