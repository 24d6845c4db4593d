// Constraints that nothing satisfies: the certificate proves it.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "core/programs/kkt_residuals.hpp"
#include "tests/unit/core/programs.hpp"

namespace bladefit::testing {
namespace {

void assert_certificate(const Constraints& c, const ActiveSetResult& result) {
  RC_ASSERT(result.status == Status::infeasible);
  RC_ASSERT(result.active.count >= 1);
  RC_ASSERT(result.active.count <= c.variables + 1);
  long double margin = 0, terms = 0;
  for (int j = 0; j < c.variables; ++j) {
    long double sum = 0, size = 0;
    for (int k = 0; k < result.active.count; ++k) {
      const auto& e = result.active.entries[static_cast<std::size_t>(k)];
      RC_ASSERT(e.multiplier > 0.0);
      const HalfSpace h = half_space(c, e.index, e.side);
      sum += static_cast<long double>(e.multiplier) * static_cast<long double>(h.normal[j]);
      size += std::abs(static_cast<long double>(e.multiplier) * static_cast<long double>(h.normal[j]));
      if (j == 0) margin += static_cast<long double>(e.multiplier) * static_cast<long double>(h.offset);
      if (j == 0) terms += static_cast<long double>(e.multiplier) * std::abs(static_cast<long double>(h.offset));
    }
    RC_ASSERT(std::abs(sum) <= 1e-12L * (1.0L + size));
  }
  RC_ASSERT(margin > 1e-9L * terms);
}

RC_GTEST_PROP(ActiveSet, ProvesThatNothingIsFeasible, ()) {
  std::mt19937_64 random = seeded();
  const int n = drawn_int(random, 1, 8), support = drawn_int(random, 1, n);
  KnownMinimum problem(random, n, 100, 0, 100);
  // sum of lambda c = 0 and sum of lambda d = margin > 0.
  Vec8 closing = Vec8::Zero();
  double offset = drawn(random, 1e-6, 1);
  for (int k = 0; k < support; ++k) {
    const Vec8 row = drawn_vector(random, n);
    const double lambda = drawn(random, 0.1, 1), d = drawn(random, -1, 1);
    closing -= lambda * row;
    offset -= lambda * d;
    if (random() % 2 == 0) {
      problem.rows.add(row, d, kUnlimited);
    } else {
      problem.rows.add(-row, -kUnlimited, -d);
    }
  }
  problem.rows.add(closing, offset, kUnlimited);
  const Constraints c = problem.constraints();
  assert_certificate(c, minimize_quadratic(problem.hessian, problem.gradient, c));
  assert_certificate(c, minimize_linear(problem.gradient, c));
}

TEST(ActiveSet, BoundsTheWrongWayRound) {
  Constraints c;
  c.variables = 3;
  c.lower[1] = 2.0;
  c.upper[1] = 1.0;
  const ActiveSetResult result = minimize_quadratic(Mat8::Identity(), Vec8::Zero(), c);
  EXPECT_EQ(result.status, Status::infeasible);
  ASSERT_EQ(result.active.count, 2);
  EXPECT_EQ(result.active.entries[0].index, 1);
  EXPECT_EQ(result.active.entries[1].index, 1);
  EXPECT_NE(result.active.entries[0].side, result.active.entries[1].side);
  EXPECT_EQ(farkas_margin(c, result.active).margin, 1.0);
  EXPECT_EQ(farkas_margin(c, result.active).combination, 0.0);
}

}  // namespace
}  // namespace bladefit::testing
