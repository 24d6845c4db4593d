#pragma once
#include "core/fit/fit_mode.hpp"
#include "core/fit/motion_lock.hpp"
#include "core/fit/quadratic_model.hpp"
#include "core/programs/active_rows.hpp"
#include "core/programs/active_set.hpp"
#include "core/programs/bound_rows.hpp"

namespace bladefit {

/// Fits whose objective or constraints bound single distances, by a sequence of linear or quadratic programs: at each
/// pose every distance is replaced by its expansion, the program is solved, the pose moves. With as many active points
/// as unknowns, as is usual, linear programs end quadratically; the constrained optimum does by the exact Hessian of
/// its Lagrangian. Rows live in the caller's memory.
class BoundedFit {
 public:
  /// `memory`: BoundRows::doubles_for(capacity); it outlives this.
  void attach(double* memory, std::uint32_t capacity) { rows_.attach(memory, capacity); }

  /// Begins a fit of mode minimax, range, min_tolerance or constrained over `count` points. `reach` [mm]: the pose
  /// moves no farther in one step.
  void begin(FitMode mode, std::uint32_t count, double reach);
  /// Goes on with `count` points, some of them new: from the present active set, with nothing to compare a step with.
  void resume(std::uint32_t count);
  /// The rows are of another problem than before: the next step is not compared with the last one.
  void compare_anew();
  [[nodiscard]] FitMode mode() const { return mode_; }

  /// Weight of point i on either side: w of min_tolerance, the tolerance [mm] of constrained. Kept until it is set
  /// again; a point of weight 0 must be skipped. Returns how much it changed at most, relative to the larger one.
  double set_weight(std::uint32_t i, const Limits& weight) { return rows_.set_weight(i, weight); }
  [[nodiscard]] Limits weight(std::uint32_t i) const { return rows_.weight(i); }
  /// Steps go along the free directions of the basis only. Given before the rows of a pose.
  void set_basis(const MotionBasis& basis);
  /// A foot that is held is none any more at the present pose: the step that led here is taken back.
  void refuse_pose() { refused_ = true; }
  /// The row of point i at the present pose.
  void set_row(std::uint32_t i, const DistanceRow& row);
  /// Point i does not count.
  void skip_row(std::uint32_t i) { rows_.skip(i); }

  /// Limit number k < count of limits at the present pose: value + gradient x <= 0 for a step x. [mm], gradient of unit
  /// length.
  void set_limit(std::uint32_t k, double value, const Vec6& gradient);
  /// Limit k binds nothing at the present pose.
  void free_limit(std::uint32_t k) { rows_.free_limit(k); }
  /// So many limits; each is set or freed before a step.
  void set_limits(std::uint32_t count);

  struct Step {
    Status status = Status::ok;  ///< of the program; not ok: no step
    Vec6 x = Vec6::Zero();       ///< from the pose of `from_last` or the present one
    bool from_last = false;      ///< the last step made things worse: a shorter one from the same pose
    bool settled = false;        ///< the step is rounding: the present pose is the optimum
  };
  /// After all rows were set: the next step. `model`: sum of 1/2 d^2 about the present pose.
  /// Cost: some ten passes over the rows.
  [[nodiscard]] Step step(const QuadraticModel& model);

  /// At the present rows: max |d|, max d - min d, max |d| / w, or for constrained max |d| / tolerance; w and tolerance
  /// of the side of d.
  [[nodiscard]] double value() const;
  /// What a step must not raise: the value, in constrained the sum of squares, and a penalty for what it breaks.
  [[nodiscard]] double merit(const QuadraticModel& model) const;

  /// Of the signed distances.
  [[nodiscard]] BoundRows::Extremes extremes() const { return rows_.extremes(); }
  /// How far row i is from its bound, in its own weight; infinite where it does not count.
  [[nodiscard]] double slack(std::uint32_t i) const;

  /// Where the distance of a point of weight w may lie at an optimum of this value with these extremes, widened by a
  /// share of its bound.
  [[nodiscard]] BoundRows::Extremes allowed(const Limits& w, double value, const BoundRows::Extremes& found,
                                            double share) const {
    if (mode_ == FitMode::range) return {found.least - share * value, found.most + share * value};
    const auto bound = [&](double weight) {
      const double of_mode = mode_ == FitMode::minimax       ? value
                             : mode_ == FitMode::constrained ? weight
                                                             : weight * value;
      return of_mode * (1.0 + share);
    };
    return {-bound(w.minus()), bound(w.plus())};
  }

  /// How many limits the solution of the last program rests on.
  [[nodiscard]] std::uint32_t active_limits() const;
  /// The rows that the solution of the last program rests on.
  [[nodiscard]] ActiveRows active_rows() const;
  /// Of the last program, at the optimum also of the fit: relative stationarity of the Karush-Kuhn-Tucker conditions.
  [[nodiscard]] double stationarity() const { return stationarity_; }

 private:
  [[nodiscard]] bool retreat(double merit, Step& step);
  void adapt_trust(double merit);
  [[nodiscard]] Constraints constraints() const;
  [[nodiscard]] Vec8 set_levels(Constraints& constraints) const;
  [[nodiscard]] ActiveSetResult solve_corrected();
  [[nodiscard]] ActiveSetResult solve_levels() const;
  [[nodiscard]] ActiveSetResult solve_curved(const ActiveSetResult& linear) const;
  [[nodiscard]] ActiveSetResult solve_bounds(const QuadraticModel& model) const;
  void set_penalty();

  BoundRows rows_;
  FitMode mode_ = FitMode::minimax;
  MotionBasis basis_;             ///< the unknowns are y in x = directions y
  double reach_ = 0, trust_ = 0;  ///< trust: how far the expansions have held [mm]
  ActiveSet active_;
  Mat6 curvature_ = Mat6::Zero();             ///< sum of multiplier * d^2 (sign d) / dx^2 over the active points
  std::array<Mat6, kMaxVariables + 1> bend_;  ///< d^2 d / dx^2 of each active point
  std::uint32_t short_steps_ = 0;             ///< that kept less than they promised, as long as they might be
  bool refused_ = false;                      ///< the present pose
  double penalty_ = 0;                        ///< of a violated tolerance or limit, above the multipliers of these
  bool curved_ = false;  ///< linear programs have promised too much: their curvature is taken into account
  struct LastStep {
    bool taken = false;
    double merit = 0, promise = 0;  ///< before it, and after it by the expansions
    Vec6 x = Vec6::Zero();
  };
  LastStep last_;
  double stationarity_ = 0;
};

}  // namespace bladefit
