#pragma once
#include <rapidcheck.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include <random>
#include <vector>

#include "core/programs/active_set.hpp"

namespace bladefit::testing {

/// Random numbers whose seed a failure prints.
inline std::mt19937_64 seeded() { return std::mt19937_64(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>())); }

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();
inline constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

inline double drawn(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline int drawn_int(std::mt19937_64& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

inline Vec8 drawn_vector(std::mt19937_64& random, int count) {
  Vec8 out = Vec8::Zero();
  for (int j = 0; j < count; ++j) out[j] = drawn(random, -1, 1);
  return out;
}

/// Rows with the memory they stand in; grows row by row.
struct OwnedRows {
  int width = 0;
  std::vector<Vec8> rows;
  std::vector<double> lower, upper, weight;
  std::vector<double> columns;

  void add(const Vec8& row, double low, double high, double w = 1.0) {
    rows.push_back(row);
    lower.push_back(low);
    upper.push_back(high);
    weight.push_back(w);
  }

  /// The view, with columns a little longer than needed. Valid until the next call or change.
  ConstraintRows view(int lower_level = -1, int upper_level = -1) {
    const std::size_t n = rows.size(), stride = n + 3;
    columns.assign(stride * static_cast<std::size_t>(width), kNotANumber);
    for (std::size_t j = 0; j < static_cast<std::size_t>(width); ++j) {
      for (std::size_t i = 0; i < n; ++i) columns[j * stride + i] = rows[i][static_cast<int>(j)];
    }
    return {columns.data(),      static_cast<std::ptrdiff_t>(stride),
            static_cast<int>(n), width,
            lower.data(),        upper.data(),
            weight.data(),       lower_level,
            upper_level};
  }
};

/// |d_i + a_i'dx| <= w_i s: variables dx and s behind it. Rows as the localizer has them: points of a bent sheet about
/// 2 long and wide, (r x n, n), or anything where `bent` is false.
inline OwnedRows minimax_rows(std::mt19937_64& random, int count, bool bent, double noise) {
  std::normal_distribution<double> normal;
  OwnedRows out;
  out.width = 6;
  const Vec8 motion = 0.1 * drawn_vector(random, 6);
  for (int i = 0; i < count; ++i) {
    Vec8 row = drawn_vector(random, 6);
    if (bent) {
      const double u = drawn(random, -1, 1), v = drawn(random, -1, 1);
      const Eigen::Vector3d r(u, v, 0.3 * u * u - 0.1 * v * u * v);
      const Eigen::Vector3d n = Eigen::Vector3d(-0.6 * u + 0.1 * v * v, 0.2 * u * v, 1.0).normalized();
      row.head<3>() = Eigen::Vector3d(r[1] * n[2] - r[2] * n[1], r[2] * n[0] - r[0] * n[2], r[0] * n[1] - r[1] * n[0]);
      row.segment<3>(3) = n;
    }
    const double d = noise * normal(random) - row.dot(motion);
    out.add(row, -d, -d);
  }
  return out;
}

inline Constraints minimax(OwnedRows& rows) {
  Constraints out;
  out.variables = rows.width + 1;
  out.rows = rows.view(rows.width, rows.width);
  return out;
}

/// The KKT conditions with everything in long double and nothing of the solver's: largest relative error of
/// stationarity, largest violation, sum of |lambda slack|, smallest lambda.
struct ExactKkt {
  long double relative = 0;  ///< stationarity by the largest sum of |terms|, as KktResiduals has it, not by a term
  long double stationarity = 0, violation = 0, complementarity = 0, least = 0;
};

inline long double exact_dot(const Vec8& a, const Vec8& x) {
  long double sum = 0;
  for (int j = 0; j < kMaxVariables; ++j) sum += static_cast<long double>(a[j]) * static_cast<long double>(x[j]);
  return sum;
}

inline ExactKkt exact_kkt(const Mat8& hessian, const Vec8& gradient, const Constraints& c, const ActiveSetResult& r) {
  ExactKkt out;
  long double scale = 0, largest_terms = 0;
  for (int j = 0; j < c.variables; ++j) {
    long double sum = static_cast<long double>(gradient[j]) + exact_dot(hessian.row(j).transpose(), r.x);
    long double terms = static_cast<long double>(std::abs(gradient[j])) +
                        exact_dot(hessian.row(j).transpose().cwiseAbs(), r.x.cwiseAbs());
    scale = std::max({scale, std::abs(sum), static_cast<long double>(std::abs(gradient[j]))});
    for (int k = 0; k < r.active.count; ++k) {
      const auto& e = r.active.entries[static_cast<std::size_t>(k)];
      const auto term =
          static_cast<long double>(e.multiplier) * static_cast<long double>(half_space(c, e.index, e.side).normal[j]);
      sum -= term;
      terms += std::abs(term);
      scale = std::max(scale, std::abs(term));
    }
    out.stationarity = std::max(out.stationarity, std::abs(sum));
    largest_terms = std::max(largest_terms, terms);
  }
  out.relative = out.stationarity / (largest_terms > 0 ? largest_terms : 1);
  out.stationarity /= scale > 0 ? scale : 1;
  for (int i = 0; i < c.rows.count + c.variables; ++i) {
    for (const Side side : {Side::lower, Side::upper}) {
      const HalfSpace h = half_space(c, i, side);
      out.violation = std::max(out.violation, static_cast<long double>(h.offset) - exact_dot(h.normal, r.x));
    }
  }
  for (int k = 0; k < r.active.count; ++k) {
    const auto& e = r.active.entries[static_cast<std::size_t>(k)];
    const HalfSpace h = half_space(c, e.index, e.side);
    const auto multiplier = static_cast<long double>(e.multiplier);
    out.complementarity += std::abs(multiplier * (static_cast<long double>(h.offset) - exact_dot(h.normal, r.x)));
    out.least = std::min(out.least, multiplier);
  }
  return out;
}

inline Mat8 drawn_hessian(std::mt19937_64& random, int n, double condition) {
  Mat8 out = Mat8::Zero();
  for (int k = 0; k < 3 * n; ++k) {
    const Vec8 v = drawn_vector(random, n);
    out += std::pow(condition, -drawn(random, 0, 1)) * v * v.transpose();
  }
  return out;
}

/// A problem whose minimum is known: x, active rows with multipliers, and a gradient that makes them stationary.
struct KnownMinimum {
  OwnedRows rows;
  Mat8 hessian;
  Vec8 gradient, x;
  std::vector<double> multiplier;  ///< of row i, 0 where it is not active

  KnownMinimum(std::mt19937_64& random, int n, int count, int active, double condition) : hessian(Mat8::Zero()) {
    rows.width = n;
    hessian = drawn_hessian(random, n, condition);
    x = drawn_vector(random, n);
    gradient = -(hessian * x);
    for (int i = 0; i < count; ++i) {
      const Vec8 row = drawn_vector(random, n);
      const double value = row.dot(x), gap = drawn(random, 1e-3, 1);
      const bool is_active = i < active, upper = random() % 2 == 0;
      const double beyond = random() % 3 == 0 ? kUnlimited : drawn(random, 1e-3, 1);
      // Some active rows have multiplier 0, some are equations.
      multiplier.push_back(is_active && random() % 5 != 0 ? drawn(random, 0.1, 2) : 0.0);
      const double other = is_active && random() % 4 == 0 ? 0.0 : beyond;
      const double near = is_active ? 0.0 : gap;
      if (upper) {
        rows.add(row, value - other, value + near);
      } else {
        rows.add(row, value - near, value + other);
      }
      gradient += (upper ? -1.0 : 1.0) * multiplier.back() * row;
    }
  }

  Constraints constraints() {
    Constraints out;
    out.variables = rows.width;
    out.rows = rows.view();
    return out;
  }
};

}  // namespace bladefit::testing
