#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace bladefit {

inline constexpr int kMaxVariables = 8;
using Vec8 = Eigen::Matrix<double, kMaxVariables, 1, Eigen::DontAlign>;
using Mat8 = Eigen::Matrix<double, kMaxVariables, kMaxVariables, Eigen::DontAlign>;

/// A bound or a step that nothing limits.
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

enum class Side : std::uint8_t { lower, upper };

/// Two-sided linear constraints in the caller's memory, column by column so that a pass over all rows streams and
/// vectorises. With x the variables, row i with coefficients a_i of x[0..width) says
///
///     a_i'x + v_i x[lower_level] >= lower_i        a_i'x - w_i x[upper_level] <= upper_i
///
/// so that -v_i s <= d_i + a_i'dx <= w_i s is one row with lower = upper = -d and both levels the index of s, and
/// s_lo <= d_i + a_i'dx <= s_hi is one row with levels -s_lo and s_hi. A level of -1 stands for no such term.
struct ConstraintRows {
  const double* coefficients = nullptr;  ///< column j begins at coefficients + j * stride
  std::ptrdiff_t stride = 0;             ///< distance of columns, at least `count`
  int count = 0;                         ///< rows
  int width = 0;                         ///< columns, 0..8
  const double* lower = nullptr;         ///< `count` bounds, -infinity = none; null: none for any row
  const double* upper = nullptr;         ///< `count` bounds, +infinity = none; null: none for any row
  const double* weight = nullptr;        ///< w; null: all 1
  int lower_level = -1, upper_level = -1;
  int plain = 0;                         ///< so many rows at the end have no level terms
  const double* lower_weight = nullptr;  ///< v; null: all w
};

/// What x may be. Bound of variable j counts as constraint `rows.count + j`.
struct Constraints {
  int variables = 0;  ///< 1..8; the others do not exist
  ConstraintRows rows;
  Vec8 lower = Vec8::Constant(-std::numeric_limits<double>::infinity());
  Vec8 upper = Vec8::Constant(std::numeric_limits<double>::infinity());
};

/// {x : normal'x >= offset}: one side of one constraint, turned so that the multiplier of a minimum is >= 0.
struct HalfSpace {
  Vec8 normal = Vec8::Zero();
  double offset = 0;
};

/// The side of constraint `index` in 0..rows.count + variables - 1. Offset -infinity: no bound there.
[[nodiscard]] HalfSpace half_space(const Constraints& constraints, int index, Side side);

/// True where a move along `direction` leads out of no half space, normals and direction compared to rounding.
[[nodiscard]] bool recedes(const Constraints& constraints, const Vec8& direction, double rounding);

/// False where a size, level or pointer does not fit. Cost: none.
[[nodiscard]] bool well_formed(const Constraints& constraints);

/// What one pass over all numbers gives: whether they may be used, and the largest |coefficient| of each variable.
struct RowMagnitudes {
  bool usable = false;  ///< coefficients and weights finite, bounds no NaN nor an infinity that no x satisfies
  Vec8 largest = Vec8::Zero();
};
[[nodiscard]] RowMagnitudes magnitudes(const Constraints& constraints);

/// The most violated constraint of each block of 64 rows, at most 32 of them: neighbours on the blade share a block and
/// say nearly the same, so that one stands for all.
struct Violations {
  struct Entry {
    double amount = 0;  ///< offset - normal'x > 0
    int index = 0;
    Side side = Side::lower;
    HalfSpace half_space = {};
  };
  std::array<Entry, 32> entries;
  int count = 0;
};

/// Constraints violated by more than `tolerance` at x; the most violated of all is among them.
/// Cost: 2 width + 4 flops a row, in the order of memory.
[[nodiscard]] Violations most_violated(const Constraints& constraints, const Vec8& x, double tolerance);

}  // namespace bladefit
