// The quadratic side of the active-set solver: minima built backwards, degenerate and infeasible problems, refusals.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "core/programs/kkt_residuals.hpp"
#include "tests/unit/core/programs.hpp"

namespace bladefit::testing {
namespace {

void assert_minimum(KnownMinimum& problem, const Constraints& c, const ActiveSetResult& result, double tolerance) {
  RC_ASSERT(result.status == Status::ok);
  RC_ASSERT((result.x - problem.x).norm() < tolerance);
  const ExactKkt exact = exact_kkt(problem.hessian, problem.gradient, c, result);
  RC_ASSERT(exact.stationarity < 4e-12L);  // a multiplier of 1e-12 of the largest is told as 0
  RC_ASSERT(exact.violation < 1e-13L);
  RC_ASSERT(exact.complementarity < 1e-11L);
  RC_ASSERT(exact.least >= 0.0L);
  RC_ASSERT(std::abs(result.residuals.stationarity - static_cast<double>(exact.relative)) < 2e-15);
  RC_ASSERT(std::abs(result.residuals.primal - static_cast<double>(exact.violation)) < 1e-14);
}

void find_the_minimum_it_was_built_from(std::mt19937_64 random) {
  const int n = drawn_int(random, 1, 8), active = drawn_int(random, 0, n);
  KnownMinimum problem(random, n, active + drawn_int(random, 0, 300), active, 1e3);
  const Constraints c = problem.constraints();
  const ActiveSetResult result = minimize_quadratic(problem.hessian, problem.gradient, c);
  assert_minimum(problem, c, result, 1e-10);
  for (int k = 0; k < result.active.count; ++k) {
    const auto& entry = result.active.entries[static_cast<std::size_t>(k)];
    RC_ASSERT(entry.index < active);
  }
}

RC_GTEST_PROP(ActiveSet, FindsTheMinimumThatTheProblemWasBuiltFrom, ()) {
  find_the_minimum_it_was_built_from(seeded());
}

/// In this one a multiplier that is rounding comes out below 0 each time it is computed.
TEST(ActiveSet, AMultiplierOfRoundingEndsTheSearch) {
  find_the_minimum_it_was_built_from(std::mt19937_64(8607209321288U));
}

RC_GTEST_PROP(ActiveSet, SurvivesMoreActiveRowsThanVariables, ()) {
  std::mt19937_64 random = seeded();
  const int n = drawn_int(random, 1, 8), active = drawn_int(random, n + 1, 4 * n + 4);
  KnownMinimum problem(random, n, active + 20, active, 10);
  // Twins, multiples and sums of active rows, all through the minimum.
  for (int k = 0; k < 2 * n; ++k) {
    const auto a = static_cast<std::size_t>(drawn_int(random, 0, active - 1));
    const auto b = static_cast<std::size_t>(drawn_int(random, 0, active - 1));
    Vec8 row = problem.rows.rows[a];
    if (k % 3 == 1) row *= 2.0;
    if (k % 3 == 2) row += problem.rows.rows[b];
    const double value = row.dot(problem.x);
    if (k % 3 == 0) {
      problem.rows.add(row, problem.rows.lower[a], problem.rows.upper[a]);
    } else {
      problem.rows.add(row, k % 2 == 0 ? value : -kUnlimited, value);
    }
  }
  const Constraints c = problem.constraints();
  assert_minimum(problem, c, minimize_quadratic(problem.hessian, problem.gradient, c), 1e-9);
}

RC_GTEST_PROP(ActiveSet, DiagonalBoxIsAClamp, ()) {
  std::mt19937_64 random = seeded();
  Constraints c;
  c.variables = drawn_int(random, 1, 8);
  Mat8 hessian = Mat8::Constant(kNotANumber);  // what lies behind the variables is not read
  const Vec8 g = drawn_vector(random, 8);
  hessian.topLeftCorner(c.variables, c.variables).setZero();
  for (int j = 0; j < c.variables; ++j) {
    hessian(j, j) = drawn(random, 0.1, 3);
    c.lower[j] = random() % 3 == 0 ? -kUnlimited : drawn(random, -1, 0.3);
    c.upper[j] = random() % 3 == 0 ? kUnlimited : drawn(random, 0.3, 1);
  }
  const ActiveSetResult result = minimize_quadratic(hessian, g, c);
  RC_ASSERT(result.status == Status::ok);
  for (int j = 0; j < 8; ++j) {
    const double expected = j < c.variables ? std::clamp(-g[j] / hessian(j, j), c.lower[j], c.upper[j]) : 0.0;
    RC_ASSERT(std::abs(result.x[j] - expected) < 1e-15 * (1.0 + 10.0 * std::abs(expected)));
  }
}

TEST(ActiveSet, WarmStartGivesTheSameWithFewerChanges) {
  std::mt19937_64 random(17);
  int cold_changes = 0, warm_changes = 0;
  for (int k = 0; k < 50; ++k) {
    KnownMinimum problem(random, 6, 500, 5, 100);
    const Constraints c = problem.constraints();
    const ActiveSetResult cold = minimize_quadratic(problem.hessian, problem.gradient, c);
    const ActiveSetResult again = minimize_quadratic(problem.hessian, problem.gradient, c, cold.active);
    EXPECT_EQ(again.changes, 0);
    EXPECT_LT((again.x - cold.x).norm(), 1e-13);
    const Vec8 moved = problem.gradient + 0.01 * drawn_vector(random, 6);
    const ActiveSetResult warm = minimize_quadratic(problem.hessian, moved, c, cold.active);
    const ActiveSetResult fresh = minimize_quadratic(problem.hessian, moved, c);
    EXPECT_EQ(warm.status, Status::ok);
    EXPECT_LT((warm.x - fresh.x).norm(), 1e-12);
    cold_changes += fresh.changes;
    warm_changes += warm.changes;
  }
  EXPECT_LT(5 * warm_changes, cold_changes);
}

/// Any active set may be given to begin with: foreign, doubled, of bounds that are not there.
RC_GTEST_PROP(ActiveSet, AnyWarmStartWillDo, ()) {
  std::mt19937_64 random = seeded();
  KnownMinimum problem(random, 5, 60, 4, 100);
  const Constraints c = problem.constraints();
  ActiveSet warm;
  warm.count = drawn_int(random, 0, 9);
  for (auto& entry : warm.entries) {
    entry = {drawn_int(random, 0, 64), random() % 2 == 0 ? Side::lower : Side::upper, drawn(random, -1, 1)};
  }
  warm.entries[1] = warm.entries[0];
  assert_minimum(problem, c, minimize_quadratic(problem.hessian, problem.gradient, c, warm), 1e-10);
}

TEST(ActiveSet, TheCapOnChangesIsKept) {
  std::mt19937_64 random(3);
  OwnedRows rows = minimax_rows(random, 2000, true, 0.1);
  const Constraints c = minimax(rows);
  for (const int cap : {0, 1, 5, 10}) {
    const ActiveSetResult result = minimize_linear(Vec8::Unit(6), c, Vec8::Zero(), {}, {0.0, cap});
    EXPECT_EQ(result.status, Status::iteration_cap);
    EXPECT_LE(result.changes, cap + kMaxVariables + 1);
    EXPECT_GT(result.residuals.primal, 0.0);
  }
}

RC_GTEST_PROP(ActiveSet, RefusesWhatIsNotANumber, ()) {
  std::mt19937_64 random = seeded();
  KnownMinimum problem(random, 4, 200, 3, 100);
  Constraints c = problem.constraints();
  const double bad = random() % 2 == 0 ? kNotANumber : (random() % 2 == 0 ? kUnlimited : -kUnlimited);
  const auto i = static_cast<std::size_t>(drawn_int(random, 0, 199));
  Vec8 gradient = problem.gradient;
  Mat8 hessian = problem.hessian;
  const int place = drawn_int(random, 0, 6);
  if (place == 0) problem.rows.columns[i] = bad;
  if (place == 1) problem.rows.weight[i] = bad;
  if (place == 2) problem.rows.lower[i] = bad > 0.0 ? bad : kNotANumber;
  if (place == 3) problem.rows.upper[i] = bad < 0.0 ? bad : kNotANumber;
  if (place == 4) gradient[2] = bad;
  if (place == 5) hessian(1, 2) = bad;
  if (place == 6) c.upper[3] = bad < 0.0 ? bad : kNotANumber;
  RC_ASSERT(minimize_quadratic(hessian, gradient, c).status == Status::not_finite);
  if (place != 5) RC_ASSERT(minimize_linear(gradient, c).status == Status::not_finite);
}

TEST(ActiveSet, RefusesWhatDoesNotFit) {
  std::mt19937_64 random(5);
  KnownMinimum problem(random, 4, 20, 3, 100);
  const Constraints good = problem.constraints();
  const auto status = [&](const auto& spoil) {
    Constraints c = good;
    spoil(c);
    return minimize_quadratic(problem.hessian, problem.gradient, c).status;
  };
  EXPECT_EQ(status([](Constraints&) {}), Status::ok);
  EXPECT_EQ(status([](Constraints& c) { c.variables = 9; }), Status::out_of_range);
  EXPECT_EQ(status([](Constraints& c) { c.variables = 3; }), Status::out_of_range);
  EXPECT_EQ(status([](Constraints& c) { c.rows.count = -1; }), Status::out_of_range);
  EXPECT_EQ(status([](Constraints& c) { c.rows.stride = 19; }), Status::out_of_range);
  EXPECT_EQ(status([](Constraints& c) { c.rows.coefficients = nullptr; }), Status::out_of_range);
  EXPECT_EQ(status([](Constraints& c) { c.rows.upper_level = 4; }), Status::out_of_range);
  EXPECT_EQ(status([](Constraints& c) { c.rows.lower_level = -2; }), Status::out_of_range);
  ActiveSet warm;
  warm.count = 1;
  warm.entries[0].index = 24;
  EXPECT_EQ(minimize_quadratic(problem.hessian, problem.gradient, good, warm).status, Status::out_of_range);
  EXPECT_EQ(minimize_quadratic(-problem.hessian, problem.gradient, good).status, Status::not_convex);
}

/// Scales over 300 decades: an end in any case, and no claim of a minimum that is not one.
RC_GTEST_PROP(ActiveSet, EndsWhateverTheScales, ()) {
  std::mt19937_64 random = seeded();
  KnownMinimum problem(random, 6, 100, 4, 100);
  const auto wild = [&] { return std::pow(10.0, drawn(random, -150, 150)); };
  for (auto& row : problem.rows.rows) row *= random() % 4 == 0 ? wild() : 1.0;
  if (random() % 2 == 0) problem.gradient *= wild();
  if (random() % 2 == 0) problem.hessian *= wild();
  const Constraints c = problem.constraints();
  for (const ActiveSetResult& result :
       {minimize_quadratic(problem.hessian, problem.gradient, c), minimize_linear(problem.gradient, c)}) {
    RC_ASSERT(result.changes <= 500 + 9 * 20);
    if (result.status != Status::ok) continue;
    RC_ASSERT(result.x.allFinite());
    RC_ASSERT(result.residuals.stationarity <= 1e-10);
    RC_ASSERT(result.residuals.least_multiplier >= 0.0);
  }
}

TEST(KktResiduals, SeeEveryKindOfError) {
  std::mt19937_64 random(9);
  KnownMinimum problem(random, 6, 50, 5, 10);
  const Constraints c = problem.constraints();
  const ActiveSetResult r = minimize_quadratic(problem.hessian, problem.gradient, c);
  ASSERT_EQ(r.status, Status::ok);
  ASSERT_GE(r.active.count, 2);
  const auto residuals = [&](const Vec8& x, const ActiveSet& active) {
    return kkt_residuals(&problem.hessian, problem.gradient, c, x, active);
  };
  const Vec8 off = r.x + Vec8(0.1 * (half_space(c, r.active.entries[0].index, r.active.entries[0].side).normal));
  EXPECT_GT(residuals(off, r.active).complementarity, 1e-4);
  const Vec8 out = r.x - Vec8(0.1 * (half_space(c, r.active.entries[0].index, r.active.entries[0].side).normal));
  EXPECT_GT(residuals(out, r.active).primal, 1e-3);
  ActiveSet wrong = r.active;
  wrong.entries[1].multiplier *= -1.0;
  EXPECT_LT(residuals(r.x, wrong).least_multiplier, 0.0);
  EXPECT_GT(residuals(r.x, wrong).stationarity, 1e-3);
}

}  // namespace
}  // namespace bladefit::testing
