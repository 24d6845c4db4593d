#pragma once
#include "core/localizer/fit_problem.hpp"
#include "core/localizer/point_store.hpp"
#include "core/programs/active_rows.hpp"

namespace bladefit {

/// What a mode is. One row a mode stands in mode_plan.cpp.
struct ModeRow {
  FitMode mode;
  // Programs are named by the mode that they were made for; a mode may share those of another.
  FitMode first;   ///< the program that follows the least-squares fit
  FitMode last;    ///< the program that it ends with
  FitMode sought;  ///< the program that further starts are made with
  enum class Then : std::uint8_t { ends, always, if_feasible } then;  ///< when the last program follows the first one
  /// How its programs compare points: by |d|, by |d| over the bound, or by how far they are from the middle of all
  /// distances.
  enum class Compared : std::uint8_t { by_distance, by_bound, by_range } compared;
  bool has_value;           ///< its optimum is a length
  bool has_certificate;     ///< that the points of the certificate prove
  bool value_is_tolerance;  ///< and it is the smallest feasible tolerance of the leading edge, the others in proportion
};

[[nodiscard]] const ModeRow& mode_row(FitMode mode);

/// The mode of a fit, and the bounds that its programs set the distances.
class ModePlan {
 public:
  explicit ModePlan(const FitProblem& problem);

  /// Whether programs follow the least-squares fit.
  [[nodiscard]] bool bounded() const { return row_.mode != FitMode::least_squares; }
  [[nodiscard]] const ModeRow& row() const { return row_; }
  /// Whether the bounds are wanted ones, so that they may be infeasible.
  [[nodiscard]] bool may_be_infeasible() const { return row_.then == ModeRow::Then::if_feasible; }
  /// Whether the last program follows after the first one has found this value.
  [[nodiscard]] bool goes_on(double value) const;

  /// w of a foot on either side: its tolerances [mm] in a constrained fit and where there are zones; else 1 at the
  /// leading edge and the ratio on the rest. 0 on both: its distance has no bound.
  [[nodiscard]] Limits weight(const Foot& foot) const;
  /// What a value of the programs is a multiple of [mm]: 1 where weights are shares, else the tightest tolerance of the
  /// leading edge, or where it has none of the rest.
  [[nodiscard]] double unit() const { return unit_; }

 private:
  const ModeRow& row_;
  ToleranceMap bounds_;
  bool by_zone_;  ///< weights are the tolerances of zones
  double unit_ = 1.0;
};

/// What is known of the mode's optimum. Lengths in mm.
struct ModeOptimum {
  double value = 0;               ///< 0 until known
  double smallest_tolerance = 0;  ///< smallest feasible tolerance of the leading edge; 0 until known
  double stationarity = 0;
  std::uint32_t held_feet = 0;  ///< FitReport::held_feet
  Certificate certificate;
  bool infeasible = false;  ///< proven: no pose meets the tolerances

  /// Takes over what the program of a row has found: only what such a program has.
  void take(const ModeRow& program, double found, const Certificate& proof);
};

/// The certificate of rows that are points of the store, named by their sequences; multipliers are per `unit` mm.
[[nodiscard]] Certificate certificate_of(const ActiveRows& rows, const PointStore& store, double unit);

}  // namespace bladefit
