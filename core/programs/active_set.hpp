#pragma once
#include "core/programs/constraint_rows.hpp"
#include "core/status.hpp"

namespace bladefit {

/// Constraints that hold with equality, with their multipliers >= 0; or the certificate of infeasibility.
struct ActiveSet {
  struct Entry {
    int index = 0;
    Side side = Side::lower;
    double multiplier = 0;
  };
  std::array<Entry, kMaxVariables + 1> entries;
  int count = 0;

  /// Its indices are of these constraints.
  [[nodiscard]] bool fits(const Constraints& constraints) const {
    if (count < 0 || count > static_cast<int>(entries.size())) return false;
    for (int k = 0; k < count; ++k) {
      const int index = entries[static_cast<std::size_t>(k)].index;
      if (index < 0 || index >= constraints.rows.count + constraints.variables) return false;
    }
    return true;
  }
};

struct ActiveSetOptions {
  double feasibility = 0;  ///< violation that is let pass beyond rounding [units of the rows]
  int max_changes = 500;   ///< of the working set, over the whole call
};

/// The Karush-Kuhn-Tucker conditions, computed from the caller's numbers after the solve. With c_k'x >= d_k the active
/// constraints and lambda_k their multipliers:
struct KktResiduals {
  double stationarity = 0;      ///< largest |H x + g - sum lambda_k c_k| over the largest sum of |terms|
  double primal = 0;            ///< largest violation over all constraints [units of the rows]
  double complementarity = 0;   ///< sum lambda_k |c_k'x - d_k| [units of the objective]
  double least_multiplier = 0;  ///< smallest lambda_k; >= 0
};

struct ActiveSetResult {
  Status status = Status::ok;
  Vec8 x = Vec8::Zero();
  double objective = 0;
  /// At a minimum: the active constraints and multipliers. Where infeasible: Farkas' certificate, constraints
  /// c_k'x >= d_k and multipliers with sum lambda_k c_k = 0 and sum lambda_k d_k > 0.
  ActiveSet active = {};
  KktResiduals residuals = {};
  int changes = 0;  ///< constraints that entered or left the working set
  int scans = 0;    ///< passes over all rows
};

/// min 1/2 x'Hx + g'x on the constraints, H symmetric positive definite (its first `variables` rows and columns).
///
/// Dual active-set method (Goldfarb and Idnani 1983): from the minimum on a working set with multipliers >= 0, a
/// violated constraint enters, those whose multiplier would turn negative leave, and the objective grows with every
/// entry, so that no working set comes back. A pass over the rows gives the worst row of each block; changes go on
/// among these before the next pass. `warm`: the active set of a similar problem, whose constraints start the working
/// set; empty: from the free minimum.
///
/// Statuses: ok; iteration_cap, precision_limit (x is the best so far, violated by residuals.primal); infeasible;
/// not_convex; not_finite (a coefficient, weight, bound, H or g); out_of_range (a size, level, pointer or index).
/// Cost: passes over the rows, 4 at least (numbers, search, proof of the end, residuals), and some microseconds a
/// change. Memory: about 10 kB of stack.
[[nodiscard]] ActiveSetResult minimize_quadratic(const Mat8& hessian, const Vec8& gradient,
                                                 const Constraints& constraints, const ActiveSet& warm = {},
                                                 const ActiveSetOptions& options = {});

/// min g'x on the constraints, from x = `start`; the other arguments and statuses as above, and unbounded.
///
/// Proximal points (Rockafellar 1976): the start is replaced by the point of the polyhedron nearest to start - step g,
/// which the quadratic method finds, until g is a combination of active normals with multipliers >= 0. For a linear
/// objective one step is enough once the step is long (Mangasarian and Meyer 1979), so that the answer is a vertex to
/// rounding, not to a regularisation: x comes from the active constraints alone, multipliers from g alone. Chosen
/// before a simplex method since it needs no first vertex, cannot cycle where vertices are degenerate, and where the
/// minimum is not one point takes the one near the start: what the rows do not determine does not move.
[[nodiscard]] ActiveSetResult minimize_linear(const Vec8& gradient, const Constraints& constraints,
                                              const Vec8& start = Vec8::Zero(), const ActiveSet& warm = {},
                                              const ActiveSetOptions& options = {});

}  // namespace bladefit
