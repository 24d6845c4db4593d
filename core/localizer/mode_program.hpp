#pragma once
#include "core/localizer/mode_plan.hpp"
#include "core/localizer/verdict_book.hpp"
#include "core/programs/bounded_fit.hpp"

namespace bladefit {

/// The program of a mode over all stored points, and the regions that its bounds follow from.
class ModeProgram {
 public:
  ModeProgram(const FitProblem& problem, const ModePlan& plan) : problem_(problem), plan_(plan) {}

  /// `rows`: BoundRows::doubles_for(capacity); they outlive the program.
  void attach(double* rows, std::uint32_t capacity) { fit_.attach(rows, capacity); }

  /// A refinement begins.
  void restart() { region_rounds_ = 0; }
  /// Begins a program over `count` points.
  void begin(FitMode mode, std::uint32_t count) { fit_.begin(mode, count, problem_.reach()); }
  [[nodiscard]] FitMode mode() const { return fit_.mode(); }

  /// Rows follow at this pose.
  void set_pose(const Pose& pose);
  /// The row of a point that counts; one without a bound is skipped.
  void set_row(std::uint32_t index, const DistanceRow& row);
  void skip_row(std::uint32_t index) { fit_.skip_row(index); }
  /// As those of BoundedFit.
  void set_limits(std::uint32_t count) { fit_.set_limits(count); }
  void set_limit(std::uint32_t k, double value, const Vec6& gradient) { fit_.set_limit(k, value, gradient); }
  void refuse_pose() { fit_.refuse_pose(); }
  void free_limit(std::uint32_t k) { fit_.free_limit(k); }
  [[nodiscard]] std::uint32_t held_feet() const { return fit_.active_limits(); }
  /// What the `distance` of a point is compared with, at a value of 1.
  [[nodiscard]] double unit_of(std::uint32_t index, double distance) const;
  /// Range of the distances at the present rows [mm].
  [[nodiscard]] double range() const;
  [[nodiscard]] double merit(const QuadraticModel& model) const { return fit_.merit(model); }
  /// Points have other feet than before: the next step is not compared with the last one.
  void compare_anew() { fit_.compare_anew(); }
  /// After all rows were set. `model`: sum of 1/2 d^2 about that pose. Cost: some ten passes over the rows.
  [[nodiscard]] BoundedFit::Step step(const QuadraticModel& model) { return fit_.step(model); }

  /// Relative stationarity of the last program.
  [[nodiscard]] double stationarity() const { return fit_.stationarity(); }
  /// In its own unit, at the present rows.
  [[nodiscard]] double value() const { return fit_.value(); }
  /// Writes what the program has found, with the points that prove it.
  void report(const PointStore& store, ModeOptimum& optimum) const;

  /// Weights and regions of all points from their present feet. Returns the largest relative change of a weight.
  double assign_regions(PointStore& store, VerdictBook& verdicts);
  /// Whether every point that counts is within the weights of its region or zone.
  [[nodiscard]] bool bounds_hold(const PointStore& store, const PointSelection& selection) const;
  enum class Regions : std::uint8_t { at_rest, changed, restless };
  /// The same where regions follow their feet: at an optimum. Restless: they have changed too often.
  [[nodiscard]] Regions follow_feet(PointStore& store, VerdictBook& verdicts);

 private:
  const FitProblem& problem_;
  const ModePlan& plan_;
  BoundedFit fit_;
  std::uint32_t region_rounds_ = 0;  ///< times that regions were reassigned
};

}  // namespace bladefit
