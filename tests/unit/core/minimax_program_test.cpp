// The linear side of the active-set solver: minimax, weighted and range problems against all vertices, against problems
// whose minimum is known to the last digit, and against NLopt's SLSQP.

#include <gtest/gtest.h>
#include <nlopt.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>

#include "tests/unit/core/programs.hpp"

namespace bladefit::testing {
namespace {

/// Least g'x over all vertices, by trying every n half spaces.
double least_vertex(const Constraints& c, const Vec8& gradient) {
  std::vector<HalfSpace> all;
  for (int i = 0; i < c.rows.count + c.variables; ++i) {
    for (const Side side : {Side::lower, Side::upper}) {
      if (half_space(c, i, side).offset > -kUnlimited) all.push_back(half_space(c, i, side));
    }
  }
  const int n = c.variables, m = static_cast<int>(all.size());
  std::vector<int> chosen(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) chosen[static_cast<std::size_t>(k)] = k;
  double least = kUnlimited;
  for (;;) {
    Eigen::MatrixXd a(n, n);
    Eigen::VectorXd b(n);
    for (int k = 0; k < n; ++k) {
      const HalfSpace& h = all[static_cast<std::size_t>(chosen[static_cast<std::size_t>(k)])];
      a.row(k) = h.normal.head(n).transpose();
      b[k] = h.offset;
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(a);
    if (lu.isInvertible()) {
      Vec8 x = Vec8::Zero();
      x.head(n) = lu.solve(b);
      const bool inside = std::all_of(all.begin(), all.end(), [&](const HalfSpace& h) {
        return h.normal.dot(x) >= h.offset - 1e-11 * (1.0 + x.norm());
      });
      if (inside) least = std::min(least, gradient.dot(x));
    }
    int k = n - 1;
    while (k >= 0 && chosen[static_cast<std::size_t>(k)] == m - n + k) --k;
    if (k < 0) return least;
    ++chosen[static_cast<std::size_t>(k)];
    for (int j = k + 1; j < n; ++j) chosen[static_cast<std::size_t>(j)] = chosen[static_cast<std::size_t>(j - 1)] + 1;
  }
}

void assert_linear_minimum(const Constraints& c, const Vec8& gradient, const ActiveSetResult& result) {
  RC_ASSERT(result.status == Status::ok);
  const ExactKkt exact = exact_kkt(Mat8::Zero(), gradient, c, result);
  RC_ASSERT(exact.stationarity < 1e-13L);
  // What a row is off by is rounding of its terms, which grow with x: near-parallel rows meet far away.
  const long double rounding = 1e-14L * (1.0L + result.x.cwiseAbs().maxCoeff());
  RC_ASSERT(exact.violation < rounding);
  RC_ASSERT(exact.complementarity < rounding);
  RC_ASSERT(exact.least >= 0.0L);
  RC_ASSERT(result.active.count <= c.variables);
}

OwnedRows few_rows(std::mt19937_64& random, int width, int count) {
  OwnedRows rows;
  rows.width = width;
  for (int i = 0; i < count; ++i) {
    const double d = drawn(random, -1, 1);
    rows.add(drawn_vector(random, width), -d, -d, random() % 2 == 0 ? 1.0 : 10.0);
  }
  return rows;
}

RC_GTEST_PROP(MinimaxProgram, WeightedMinimaxIsTheBestVertex, ()) {
  std::mt19937_64 random = seeded();
  const int width = drawn_int(random, 1, 3);
  OwnedRows rows = few_rows(random, width, width + drawn_int(random, 1, 6));
  if (random() % 2 == 0) rows.add(rows.rows[0], rows.lower[0], rows.upper[0], rows.weight[0]);
  Constraints c;
  c.variables = width + 1;
  c.rows = rows.view(width, width);
  std::vector<double> below;  // another weight on the lower side
  for (std::size_t i = 0; i < rows.weight.size(); ++i) below.push_back(drawn(random, 0.3, 10));
  if (random() % 2 == 0) c.rows.lower_weight = below.data();
  const Vec8 g = Vec8::Unit(width);
  const ActiveSetResult result = minimize_linear(g, c);
  assert_linear_minimum(c, g, result);
  RC_ASSERT(std::abs(result.objective - least_vertex(c, g)) < 1e-11);
}

/// min t + s with d + a'x >= -t, d + a'x <= s: two levels.
RC_GTEST_PROP(MinimaxProgram, RangeIsTheBestVertex, ()) {
  std::mt19937_64 random = seeded();
  const int width = drawn_int(random, 1, 2);
  OwnedRows rows = few_rows(random, width, width + drawn_int(random, 2, 6));
  Constraints c;
  c.variables = width + 2;
  c.rows = rows.view(width, width + 1);
  c.rows.weight = nullptr;
  // A constant in d moves both levels together: without a bound the minimum has no vertex.
  const Vec8 g = Vec8::Unit(width) + Vec8::Unit(width + 1);
  const ActiveSetResult result = minimize_linear(g, c);
  assert_linear_minimum(c, g, result);
  RC_ASSERT(std::abs(result.objective - least_vertex(c, g)) < 1e-11);
}

/// Built backwards: seven rows whose signed normals combine to 0 hold the maximum at a known motion.
RC_GTEST_PROP(MinimaxProgram, SmallestMaximumToTheLastDigits, ()) {
  std::mt19937_64 random = seeded();
  const Vec8 x = 0.01 * drawn_vector(random, 6);
  const double s = std::pow(10.0, drawn(random, -5, 0));
  OwnedRows rows;
  rows.width = 6;
  Vec8 closing = Vec8::Zero();
  const auto add = [&](const Vec8& row, double residual) {
    rows.add(row, row.dot(x) - residual, row.dot(x) - residual);
  };
  for (int k = 0; k < 6; ++k) {
    const Vec8 row = drawn_vector(random, 6);
    const double sign = random() % 2 == 0 ? 1.0 : -1.0;
    closing -= sign * drawn(random, 0.2, 1) * row;
    add(row, sign * s);
  }
  add(closing, s);
  const int others = drawn_int(random, 0, 2000);
  for (int k = 0; k < others; ++k) add(drawn_vector(random, 6), drawn(random, -0.999, 0.999) * s);
  const Constraints c = minimax(rows);
  const ActiveSetResult result = minimize_linear(Vec8::Unit(6), c);
  assert_linear_minimum(c, Vec8::Unit(6), result);
  // The rows themselves are rounded at the size of a'x.
  RC_ASSERT(std::abs(result.objective - s) < 1e-14 * s + 1e-17);
  for (int k = 0; k < result.active.count; ++k) {
    RC_ASSERT(result.active.entries[static_cast<std::size_t>(k)].index < 7);
  }
}

/// SLSQP on the same problem.
double by_nlopt(const Constraints& c, const Vec8& start) {
  std::vector<HalfSpace> all;
  for (int i = 0; i < c.rows.count; ++i) {
    for (const Side side : {Side::lower, Side::upper}) all.push_back(half_space(c, i, side));
  }
  const auto objective = [](unsigned n, const double* x, double* gradient, void*) {
    for (unsigned j = 0; gradient && j < n; ++j) gradient[j] = j + 1 == n ? 1.0 : 0.0;
    return x[n - 1];
  };
  const auto constraint = [](unsigned m, double* result, unsigned n, const double* x, double* gradient, void* data) {
    const auto& spaces = *static_cast<std::vector<HalfSpace>*>(data);
    for (unsigned i = 0; i < m; ++i) {
      result[i] = spaces[i].offset;
      for (unsigned j = 0; j < n; ++j) {
        result[i] -= spaces[i].normal[j] * x[j];
        if (gradient) gradient[i * n + j] = -spaces[i].normal[j];
      }
    }
  };
  const auto n = static_cast<unsigned>(c.variables);
  nlopt_opt optimizer = nlopt_create(NLOPT_LD_SLSQP, n);
  nlopt_set_min_objective(optimizer, objective, nullptr);
  const std::vector<double> tolerance(all.size(), 1e-12);
  nlopt_add_inequality_mconstraint(optimizer, static_cast<unsigned>(all.size()), constraint, &all, tolerance.data());
  nlopt_set_xtol_rel(optimizer, 1e-13);
  nlopt_set_maxeval(optimizer, 500);
  double value = kNotANumber;
  std::vector<double> x(start.data(), start.data() + n);
  const nlopt_result status = nlopt_optimize(optimizer, x.data(), &value);
  nlopt_destroy(optimizer);
  return status > 0 || status == NLOPT_ROUNDOFF_LIMITED ? value : kNotANumber;
}

TEST(MinimaxProgram, AgreesWithSlsqp) {
  std::mt19937_64 random(23);
  for (int k = 0; k < 12; ++k) {
    OwnedRows rows = minimax_rows(random, 60 + 10 * k, k % 2 == 0, 0.05);
    const Constraints c = minimax(rows);
    const ActiveSetResult result = minimize_linear(Vec8::Unit(6), c);
    ASSERT_EQ(result.status, Status::ok);
    EXPECT_NEAR(result.objective, by_nlopt(c, Vec8::Unit(6)), 1e-9) << k;
  }
}

TEST(MinimaxProgram, TenThousandRowsTakeFewPasses) {
  std::mt19937_64 random(29);
  for (const bool bent : {true, false}) {
    OwnedRows rows = minimax_rows(random, 10000, bent, 0.05);
    const Constraints c = minimax(rows);
    const ActiveSetResult result = minimize_linear(Vec8::Unit(6), c);
    EXPECT_EQ(result.status, Status::ok);
    EXPECT_LT(result.residuals.primal, 1e-15);
    EXPECT_LT(result.changes, 150);
    EXPECT_LT(result.scans, 25);
    const ActiveSetResult again = minimize_linear(Vec8::Unit(6), c, result.x, result.active);
    EXPECT_EQ(again.changes, 0);
    EXPECT_EQ(again.scans, 4);
    EXPECT_LT((again.x - result.x).norm(), 1e-14);
  }
}

TEST(MinimaxProgram, WarmStartGivesTheSameWithFewerChanges) {
  std::mt19937_64 random(31);
  int cold_changes = 0, warm_changes = 0;
  for (int k = 0; k < 30; ++k) {
    OwnedRows rows = minimax_rows(random, 1261, k % 2 == 0, 0.05);
    const ActiveSetResult before = minimize_linear(Vec8::Unit(6), minimax(rows));
    for (std::size_t i = 0; i < rows.rows.size(); ++i) {
      rows.lower[i] += 1e-5 * drawn(random, -1, 1);
      rows.upper[i] = rows.lower[i];
    }
    const Constraints c = minimax(rows);
    const ActiveSetResult cold = minimize_linear(Vec8::Unit(6), c);
    const ActiveSetResult warm = minimize_linear(Vec8::Unit(6), c, before.x, before.active);
    ASSERT_EQ(warm.status, Status::ok);
    EXPECT_NEAR(warm.objective, cold.objective, 1e-15);
    // The minimum in s is sharp, x where the problem is flat less so.
    EXPECT_LT((warm.x - cold.x).norm(), 1e-11);
    cold_changes += cold.changes;
    warm_changes += warm.changes;
  }
  EXPECT_LT(5 * warm_changes, cold_changes) << "changes, cold " << cold_changes << ", warm " << warm_changes;
}

/// Directions that no row sees stay where they were.
RC_GTEST_PROP(MinimaxProgram, WhatIsNotDeterminedDoesNotMove, ()) {
  std::mt19937_64 random = seeded();
  OwnedRows rows = minimax_rows(random, 300, false, 0.05);
  for (Vec8& row : rows.rows) row[2] = row[4] = 0.0;
  const Constraints c = minimax(rows);
  const Vec8 start = drawn_vector(random, 7);
  const ActiveSetResult result = minimize_linear(Vec8::Unit(6), c, start);
  assert_linear_minimum(c, Vec8::Unit(6), result);
  RC_ASSERT(result.x[2] == start[2]);
  RC_ASSERT(result.x[4] == start[4]);
}

/// Fewer rows than variables: the maximum is 0, the motion the smallest that gets there.
TEST(MinimaxProgram, FewRowsAreMetExactly) {
  std::mt19937_64 random(37);
  for (int count = 1; count <= 6; ++count) {
    OwnedRows rows = minimax_rows(random, count, false, 0.1);
    const Constraints c = minimax(rows);
    const ActiveSetResult result = minimize_linear(Vec8::Unit(6), c);
    EXPECT_EQ(result.status, Status::ok) << count;
    EXPECT_NEAR(result.objective, 0.0, 1e-15);
  }
}

TEST(MinimaxProgram, NoObjectiveIsTheNearestFeasiblePoint) {
  Constraints c;
  c.variables = 2;
  const double coefficients[] = {1.0, 1.0}, lower[] = {2.0};
  c.rows = {coefficients, 1, 1, 2, lower, nullptr, nullptr, -1, -1};
  const ActiveSetResult result = minimize_linear(Vec8::Zero(), c);
  EXPECT_EQ(result.status, Status::ok);
  EXPECT_NEAR(result.x[0], 1.0, 1e-15);
  EXPECT_NEAR(result.x[1], 1.0, 1e-15);
}

TEST(MinimaxProgram, SaysThatThereIsNoMinimum) {
  std::mt19937_64 random(41);
  for (int n = 1; n <= 8; ++n) {
    Constraints c;
    c.variables = n;
    const Vec8 g = drawn_vector(random, n);
    EXPECT_EQ(minimize_linear(g, c).status, Status::unbounded);
    for (int j = 0; j < n; ++j) (g[j] < 0.0 ? c.lower : c.upper)[j] = drawn(random, -1, 1);
    EXPECT_EQ(minimize_linear(g, c).status, Status::unbounded);
    for (int j = 0; j < n; ++j) (g[j] < 0.0 ? c.upper : c.lower)[j] = 2.0 * (g[j] < 0.0 ? 1.0 : -1.0);
    const ActiveSetResult bounded = minimize_linear(g, c);
    EXPECT_EQ(bounded.status, Status::ok);
    for (int j = 0; j < n; ++j) EXPECT_EQ(bounded.x[j], g[j] < 0.0 ? 2.0 : -2.0);
  }
}

/// A step length inside a box, as a trust region has it.
RC_GTEST_PROP(MinimaxProgram, KeepsToATrustRegion, ()) {
  std::mt19937_64 random = seeded();
  OwnedRows rows = minimax_rows(random, 200, true, 0.05);
  Constraints c = minimax(rows);
  const double radius = std::pow(10.0, drawn(random, -6, 0));
  c.lower.head<6>().setConstant(-radius);
  c.upper.head<6>().setConstant(radius);
  const ActiveSetResult result = minimize_linear(Vec8::Unit(6), c);
  assert_linear_minimum(c, Vec8::Unit(6), result);
  RC_ASSERT(result.x.head<6>().cwiseAbs().maxCoeff() <= radius * (1.0 + 1e-14));
}

}  // namespace
}  // namespace bladefit::testing
