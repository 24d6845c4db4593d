#pragma once
#include "core/localizer/mode_fit.hpp"
#include "core/localizer/refinement_phase.hpp"

namespace bladefit {

/// The fit over all stored points, in sweeps that can be cut into pieces: to the least-squares optimum, from there by
/// the mode's programs to its optimum, and from other poses to a better one. It moves the pose and changes the stored
/// points.
class Refinement {
 public:
  Refinement(const FitProblem& problem, const ModePlan& plan, const FootFinder& finder, PointStore& store,
             PointSelection& selection, RunningSums& sums, PoseEstimate& estimate, LossSchedule& loss,
             VerdictBook& verdicts);

  /// As ModeFit::attach().
  void attach(double* rows, KeptPlaces* places, std::uint32_t capacity) { mode_.attach(rows, places, capacity); }
  /// Forgets all points.
  void clear();
  /// A point has come, or more is wanted than what was found: what is under way is given up.
  void interrupt();
  [[nodiscard]] RefinementPhase phase() const { return phase_; }

  /// From the present pose. `concluded`: every direction that the points determine at all is used. Cost: linear.
  void begin(bool concluded, ModeOptimum& optimum);
  /// Measures up to `max_points` points. Returns ok (converged), underdetermined (converged in the determined
  /// directions), more_work, or iteration_cap.
  [[nodiscard]] Status advance(std::uint32_t max_points, bool concluded, ModeOptimum& optimum);

  [[nodiscard]] const FurtherStarts& further_starts() const { return mode_.further_starts(); }
  /// Why the last refinement has not converged.
  [[nodiscard]] FitEnd ended() const { return ended_; }
  /// Feet whose search met its cap in the last sweep.
  [[nodiscard]] std::uint32_t unproven() const { return unproven_; }

 private:
  /// What a call of advance() is given beside the parts.
  struct Call {
    bool concluded;
    ModeOptimum& optimum;
  };
  void enter(RefinementEvent event) { phase_ = next_phase(phase_, event); }
  [[nodiscard]] Status give_up(FitEnd why);
  [[nodiscard]] Status follow(ModeFit::Next next);
  [[nodiscard]] Status start_on(const Call& call);
  void begin_sweep();
  std::uint32_t sweep_on(std::uint32_t max_points);
  [[nodiscard]] FootStart start_of(std::uint32_t index) const;
  void take_in(std::uint32_t index, const Measurement& m);
  void take_in(std::uint32_t index, const LaneFoot& foot);
  [[nodiscard]] Status finish_sweep(const Call& call);
  [[nodiscard]] double solve(bool concluded);

  [[nodiscard]] Status least_squares_step(const Call& call);
  [[nodiscard]] bool feet_restless() const;
  [[nodiscard]] bool retreat();

  /// The sum of squares before the last step.
  struct Descent {
    double value = 0;
    std::uint32_t count = 0;
  };

  const FitProblem& problem_;
  const ModePlan& plan_;
  const FootFinder& finder_;
  PointStore& store_;
  PointSelection& selection_;
  RunningSums& sums_;
  PoseEstimate& estimate_;
  LossSchedule& loss_;
  RefinementPhase phase_ = RefinementPhase::idle;
  Sweep sweep_;
  Descent descent_;
  ModeFit mode_;
  std::uint32_t unproven_ = 0;
  FitEnd ended_ = FitEnd::none;
};

}  // namespace bladefit
