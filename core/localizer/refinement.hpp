#pragma once
#include "core/localizer/further_starts.hpp"
#include "core/localizer/sheet_descent.hpp"
#include "core/localizer/refinement_phase.hpp"
#include "core/localizer/running_sums.hpp"
#include "core/localizer/sweep.hpp"

namespace bladefit {

/// The fit over all stored points, in sweeps that can be cut into pieces: to the least-squares optimum, from there by
/// the mode's programs to its optimum, and from other poses to a better one. It moves the pose and changes the stored
/// points.
class Refinement {
 public:
  Refinement(const FitProblem& problem, const ModePlan& plan, const FootFinder& finder, PointStore& store,
             PointSelection& selection, RunningSums& sums, PoseEstimate& estimate, LossSchedule& loss,
             VerdictBook& verdicts);

  void attach(double* rows, SurfacePlace* places, std::uint32_t capacity) {
    program_.attach(rows, capacity);
    descent_sheets_.attach(places, capacity);
  }
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

  [[nodiscard]] const FurtherStarts& further_starts() const { return starts_; }
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
  [[nodiscard]] std::uint32_t most_sweeps() const;
  [[nodiscard]] Status given_up(FitEnd why);
  void enter(RefinementEvent event) { phase_ = next_phase(phase_, event); }
  void begin_sweep();
  std::uint32_t sweep_on(std::uint32_t max_points);
  void take_in(std::uint32_t index, const Measurement& m);
  [[nodiscard]] Status finish_sweep(const Call& call);
  [[nodiscard]] double solve(bool concluded);

  [[nodiscard]] Status least_squares_step(const Call& call);
  [[nodiscard]] bool retreat();

  void settle_selection();
  void begin_program(FitMode mode, bool there);
  [[nodiscard]] Status program_step(const Call& call);
  [[nodiscard]] Status program_optimum(const Call& call);

  [[nodiscard]] bool begin_starts(double own_value, bool concluded);
  [[nodiscard]] bool seek_better(double value, bool concluded);
  [[nodiscard]] bool go_elsewhere(bool concluded);
  [[nodiscard]] bool go_back();
  [[nodiscard]] Status start_on(ModeOptimum& optimum);

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
  VerdictBook& verdicts_;
  RefinementPhase phase_ = RefinementPhase::idle;
  Sweep sweep_;
  Descent descent_;
  ModeProgram program_;
  SheetDescent descent_sheets_;
  FurtherStarts starts_;
  std::uint32_t unproven_ = 0;
  double squares_range_ = 0;  ///< range of the distances at the least-squares optimum [mm]
  bool proof_wanted_ = false;  ///< the next sweep is to prove every foot
  FitEnd ended_ = FitEnd::none;
};

}  // namespace bladefit
