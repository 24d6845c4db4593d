#include "core/programs/constraint_rows.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

constexpr int kBlock = 64;
using Block = std::array<double, kBlock>;

/// A maximum that is one instruction, and vectorises.
double larger(double a, double b) { return a > b ? a : b; }

/// v of the rows; null: all 1.
const double* lower_weight(const ConstraintRows& rows) { return rows.lower_weight ? rows.lower_weight : rows.weight; }

/// Adds factor * column, or the factor alone where there is no column.
void add_multiple(Block& sum, const double* column, double factor, int count) {
  for (int i = 0; i < count; ++i) sum[static_cast<std::size_t>(i)] += factor * (column ? column[i] : 1.0);
}

double largest(Block values) {
  for (std::size_t half = kBlock / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) values[i] = larger(values[i], values[i + half]);
  }
  return values[0];
}

/// gap[i] = offset - normal'x of one side of rows first..first+count; -infinity behind them.
struct Gaps {
  Block lower, upper;
};

void gaps(const ConstraintRows& rows, const Vec8& x, int first, int count, Gaps& out) {
  Block value{};
  for (int j = 0; j < rows.width; ++j) {
    add_multiple(value, rows.coefficients + j * rows.stride + first, x[j], count);
  }
  out.lower.fill(-kUnbounded);
  out.upper.fill(-kUnbounded);
  const auto from_first = [first](const double* weight) { return weight ? weight + first : nullptr; };
  const int leveled = std::clamp(rows.count - rows.plain - first, 0, count);
  const auto n = static_cast<std::size_t>(count);
  if (rows.lower) {
    for (std::size_t i = 0; i < n; ++i) out.lower[i] = rows.lower[static_cast<std::size_t>(first) + i] - value[i];
    if (rows.lower_level >= 0) add_multiple(out.lower, from_first(lower_weight(rows)), -x[rows.lower_level], leveled);
  }
  if (rows.upper) {
    for (std::size_t i = 0; i < n; ++i) out.upper[i] = value[i] - rows.upper[static_cast<std::size_t>(first) + i];
    if (rows.upper_level >= 0) add_multiple(out.upper, from_first(rows.weight), -x[rows.upper_level], leveled);
  }
}

struct ColumnSummary {
  double largest = 0;  ///< |value|
  double doubt = 0;    ///< 0, or NaN where a value is a NaN or an infinity that counts
};

/// Values are cut to [-below, above] first, so that an infinity counts only where there is no such cut.
ColumnSummary summary_of(const double* column, int count, double above, double below) {
  Block most{}, doubt{};
  for (int first = 0; first < count; first += kBlock) {
    const auto n = static_cast<std::size_t>(std::min(kBlock, count - first));
    const double* values = column + first;
    for (std::size_t i = 0; i < n; ++i) {
      // In this order the comparisons let a NaN pass.
      const double cut = above < values[i] ? above : values[i];
      const double value = cut < -below ? -below : cut;
      doubt[i] += 0.0 * value;
      most[i] = larger(std::abs(value), most[i]);
    }
  }
  ColumnSummary out{largest(most), 0.0};
  for (const double value : doubt) out.doubt += value;
  return out;
}

void insert(Violations& list, const Violations::Entry& entry) {
  const auto capacity = static_cast<int>(list.entries.size());
  if (list.count < capacity) {
    list.entries[static_cast<std::size_t>(list.count++)] = entry;
    return;
  }
  auto* least = std::min_element(list.entries.begin(), list.entries.end(),
                                 [](const auto& a, const auto& b) { return a.amount < b.amount; });
  if (entry.amount > least->amount) *least = entry;
}

void insert_worst(Violations& list, const Block& gap, double worst, int first, Side side) {
  const auto* at = std::find(gap.begin(), gap.end(), worst);
  insert(list, {worst, first + static_cast<int>(at - gap.begin()), side, {}});
}

}  // namespace

HalfSpace half_space(const Constraints& constraints, int index, Side side) {
  const ConstraintRows& rows = constraints.rows;
  const double sign = side == Side::lower ? 1.0 : -1.0;
  HalfSpace out;
  if (index >= rows.count) {
    const int j = index - rows.count;
    out.normal[j] = sign;
    out.offset = sign * (side == Side::lower ? constraints.lower[j] : constraints.upper[j]);
    return out;
  }
  for (int j = 0; j < rows.width; ++j) out.normal[j] = sign * rows.coefficients[j * rows.stride + index];
  const int of_level = side == Side::lower ? rows.lower_level : rows.upper_level;
  const double* weight = side == Side::lower ? lower_weight(rows) : rows.weight;
  if (of_level >= 0 && index < rows.count - rows.plain) out.normal[of_level] += weight ? weight[index] : 1.0;
  const double* bound = side == Side::lower ? rows.lower : rows.upper;
  out.offset = bound ? sign * bound[index] : -kUnbounded;
  return out;
}

bool recedes(const Constraints& constraints, const Vec8& direction, double rounding) {
  const int count = constraints.rows.count + constraints.variables;
  for (int i = 0; i < count; ++i) {
    for (const Side side : {Side::lower, Side::upper}) {
      const HalfSpace h = half_space(constraints, i, side);
      const double least = -rounding * h.normal.norm() * direction.norm();
      if (h.offset > -kUnbounded && h.normal.dot(direction) < least) return false;
    }
  }
  return true;
}

bool well_formed(const Constraints& constraints) {
  const ConstraintRows& rows = constraints.rows;
  const int n = constraints.variables;
  if (n < 1 || n > kMaxVariables || rows.count < 0 || rows.width < 0 || rows.width > n) return false;
  if (rows.count > std::numeric_limits<int>::max() - kMaxVariables) return false;
  if (rows.plain < 0 || rows.plain > rows.count) return false;
  if (rows.lower_level < -1 || rows.lower_level >= n || rows.upper_level < -1 || rows.upper_level >= n) return false;
  return rows.count == 0 || rows.width == 0 || (rows.coefficients && rows.stride >= rows.count);
}

RowMagnitudes magnitudes(const Constraints& constraints) {
  const ConstraintRows& rows = constraints.rows;
  RowMagnitudes out;
  double doubt = 0.0;
  const auto take = [&](const double* column, double above, double below) {
    const ColumnSummary summary = column ? summary_of(column, rows.count, above, below) : ColumnSummary{};
    doubt += summary.doubt;
    return summary.largest;
  };
  for (int j = 0; j < rows.width; ++j)
    out.largest[j] = take(rows.coefficients + j * rows.stride, kUnbounded, kUnbounded);
  double weight = rows.weight ? take(rows.weight, kUnbounded, kUnbounded) : 1.0;
  if (rows.lower_weight) weight = larger(take(rows.lower_weight, kUnbounded, kUnbounded), weight);
  take(rows.lower, kUnbounded, 0.0);
  take(rows.upper, 0.0, kUnbounded);
  for (const int l : {rows.lower_level, rows.upper_level}) {
    if (l >= 0) out.largest[l] += weight;
  }
  out.usable = doubt == 0.0;
  for (int j = 0; j < constraints.variables; ++j) {
    const bool bounded = constraints.lower[j] > -kUnbounded || constraints.upper[j] < kUnbounded;
    out.largest[j] = larger(out.largest[j], bounded ? 1.0 : 0.0);
    out.usable = out.usable && constraints.lower[j] < kUnbounded && constraints.upper[j] > -kUnbounded;
  }
  return out;
}

Violations most_violated(const Constraints& constraints, const Vec8& x, double tolerance) {
  const ConstraintRows& rows = constraints.rows;
  Violations out;
  Gaps block;
  for (int first = 0; first < rows.count; first += kBlock) {
    gaps(rows, x, first, std::min(kBlock, rows.count - first), block);
    const double lower = largest(block.lower), upper = largest(block.upper);
    if (lower > tolerance && lower >= upper) insert_worst(out, block.lower, lower, first, Side::lower);
    if (upper > tolerance && upper > lower) insert_worst(out, block.upper, upper, first, Side::upper);
  }
  for (int j = 0; j < constraints.variables; ++j) {
    const double lower = constraints.lower[j] - x[j], upper = x[j] - constraints.upper[j];
    if (lower > tolerance) insert(out, {lower, rows.count + j, Side::lower, {}});
    if (upper > tolerance) insert(out, {upper, rows.count + j, Side::upper, {}});
  }
  for (int k = 0; k < out.count; ++k) {
    Violations::Entry& entry = out.entries[static_cast<std::size_t>(k)];
    entry.half_space = half_space(constraints, entry.index, entry.side);
  }
  return out;
}

}  // namespace bladefit
