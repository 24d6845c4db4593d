#pragma once
#include "core/localizer/foot_finder.hpp"
#include "core/localizer/kept_sheets.hpp"
#include "core/localizer/known_rests.hpp"
#include "core/localizer/mode_program.hpp"

namespace bladefit {

/// A search for a better optimum of a mode beside least squares, which has several: its program starts again from poses
/// about the least-squares optimum, over every `stride`-th point. The search changes neither the pose nor any stored
/// point; what it finds is to be made exact over all points.
class FurtherStarts {
 public:
  enum class Phase : std::uint8_t { waiting, running, done, went_back };

  FurtherStarts(const FitProblem& problem, const ModePlan& plan, const FootFinder& finder,
                const PointSelection& selection)
      : problem_(problem), plan_(plan), finder_(finder), selection_(selection) {}

  /// A refinement begins.
  void restart();
  /// The search under way, if any, is given up.
  void interrupt();
  /// At the least-squares optimum: the starts lie about it along the eigenvectors of its information matrix.
  void plan(const Pose& centre, const QuadraticModel& model);
  /// The mode has found an optimum of this value at `own_pose`, or none: infinite.
  void begin(double own_value, const Pose& own_pose, std::uint32_t points, ModeProgram& program);

  enum class Outcome : std::uint8_t { running, better, not_better };
  /// Measures the next points of a start's sweep, as many as there are lanes where there are so many. Feet are searched
  /// in the first sweep of a start and keep their sheets from there. Cost: some microseconds, and at the end of a sweep
  /// a step of the program.
  [[nodiscard]] Outcome advance(PointStore& store, const QuadraticModel& model, ModeProgram& program,
                                KeptSheets& sheets);

  /// All starts have been made.
  [[nodiscard]] bool done() const { return phase_ == Phase::done || phase_ == Phase::went_back; }
  [[nodiscard]] bool found_before() const;
  /// The least-squares optimum.
  [[nodiscard]] const Pose& centre() const { return centre_; }
  [[nodiscard]] double own_value() const { return own_.value; }
  [[nodiscard]] const Pose& own_pose() const { return own_.pose; }
  [[nodiscard]] const Pose& best_pose() const { return best_.pose; }
  /// Over all points the best of the starts is not better than what was found before: that counts again. False where
  /// that cannot be, or was done before.
  [[nodiscard]] bool go_back();
  /// How many of the starts led to the optimum that counts.
  [[nodiscard]] std::uint32_t same() const { return same_; }

 private:
  void begin_start(ModeProgram& program);
  void sweep_on(PointStore& store, ModeProgram& program, KeptSheets& sheets);
  [[nodiscard]] bool matters(const ModeProgram& program, std::uint32_t i, const Measurement& m) const;
  void take_in(PointStore& store, std::uint32_t i, const Measurement& m, ModeProgram& program, KeptSheets& sheets);
  void finish_sweep(const QuadraticModel& model, ModeProgram& program, KeptSheets& sheets);
  void come_to(double value);
  void end_start(double last_value, ModeProgram& program);

  /// The optimum that the mode has found. Its value over all points, infinite where there is none, and over those that
  /// are looked at.
  struct Own {
    Pose pose;
    double value = 0, found = 0;
  };
  /// An optimum over the points that are looked at.
  struct Found {
    double value = 0;
    Pose pose;
  };
  /// Of the start under way. Number 0 starts from the optimum that the mode has found, for comparison.
  struct Start {
    std::uint32_t number = 0, sweeps = 0, cursor = 0;
    std::uint32_t others = 0, proofs = 0;  ///< feet that were found on other sheets, and sweeps that looked for them
    bool proves = false;                   ///< feet of this sweep are searched
    Found found;                           ///< the best so far
    Pose pose, last_pose;
  };

  const FitProblem& problem_;
  const ModePlan& plan_;
  const FootFinder& finder_;
  const PointSelection& selection_;
  Phase phase_ = Phase::waiting;
  Pose centre_;                ///< the least-squares optimum
  Mat6 steps_ = Mat6::Zero();  ///< columns: from there to a start; as many lie opposite
  Own own_;
  std::uint32_t stride_ = 1, points_ = 0;
  Start start_;
  Found best_;
  KnownRests rests_;
  std::uint32_t same_ = 0, same_as_own_ = 0;  ///< starts that came to the best optimum, and to the mode's own
};

}  // namespace bladefit
