#pragma once
#include "core/localizer/further_starts.hpp"
#include "core/localizer/mode_program.hpp"
#include "core/localizer/running_sums.hpp"
#include "core/localizer/sheet_descent.hpp"
#include "core/localizer/sweep.hpp"

namespace bladefit {

/// What follows the least-squares fit in the other modes: their programs, one after the other, and further starts. It
/// moves the pose after each sweep over the points.
class ModeFit {
 public:
  ModeFit(const FitProblem& problem, const ModePlan& plan, const FootFinder& finder, PointStore& store,
          PointSelection& selection, RunningSums& sums, PoseEstimate& estimate, VerdictBook& verdicts, Sweep& sweep);

  /// As BoundRows::doubles_for() and KeptSheets::attach().
  void attach(double* rows, KeptPlaces* places, std::uint32_t capacity);
  /// A refinement begins.
  void restart();
  /// What is under way is given up.
  void interrupt() { starts_.interrupt(); }

  /// What comes next.
  enum class Next : std::uint8_t {
    goes_on,  ///< another sweep of the same program
    begins,   ///< the sweeps of another program
    seeks,    ///< further starts
    optimum,  ///< nothing: the pose is the optimum
    given_up  ///< nothing: see why()
  };
  /// Every foot at the pose was searched. `at_squares`: it is the least-squares optimum. optimum: it is that of the
  /// mode as well, since it meets the tolerances that a constrained fit must keep.
  [[nodiscard]] Next begin(bool at_squares);

  /// A sweep of a program: it begins, each point is measured, from a place that is told, and it ends.
  void begin_sweep();
  [[nodiscard]] FootStart start_of(std::uint32_t index) const;
  void note(std::uint32_t index, const Measurement& m, bool counts);
  void set_row(std::uint32_t index, const DistanceRow& row) { program_.set_row(index, row); }
  [[nodiscard]] Next finish_sweep(bool concluded, ModeOptimum& optimum);
  /// The program was given up. given_up: there is no other way.
  [[nodiscard]] Next go_elsewhere(bool concluded);

  /// The next points of a further start. Of the best of the starts over all points a program begins.
  [[nodiscard]] Next start_on(bool proven, ModeOptimum& optimum);

  [[nodiscard]] FitEnd why() const { return why_; }
  [[nodiscard]] const FurtherStarts& further_starts() const { return starts_; }

 private:
  [[nodiscard]] Next give_up(FitEnd why);
  [[nodiscard]] Next begin_program(FitMode mode, bool there);
  [[nodiscard]] Next begin_program_at(FitMode mode, const Pose& pose);
  [[nodiscard]] Next go_on_from_proven();
  [[nodiscard]] Next let_go(FitEnd why);
  [[nodiscard]] Next at_optimum(bool concluded, ModeOptimum& optimum);
  [[nodiscard]] Next begin_last_program();
  [[nodiscard]] Next begin_starts(double own_value, bool concluded);
  [[nodiscard]] Next seek_better(double value, bool concluded);
  [[nodiscard]] Next go_back(Next otherwise);

  const FitProblem& problem_;
  const ModePlan& plan_;
  PointStore& store_;
  PointSelection& selection_;
  RunningSums& sums_;
  PoseEstimate& estimate_;
  VerdictBook& verdicts_;
  Sweep& sweep_;
  ModeProgram program_;
  SheetDescent sheets_;
  FurtherStarts starts_;
  std::uint32_t sweeps_ = 0;  ///< of all programs of the refinement
  double squares_range_ = 0;  ///< range of the distances at the least-squares optimum [mm]
  FitEnd why_ = FitEnd::none;
};

}  // namespace bladefit
