// Taylor forms against sums of Bernstein polynomials, and Newton's walk by what it promises.

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/geometry/nearest/newton_walk.hpp"
#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/bernstein.hpp"

namespace bladefit::testing {
namespace {

double distance_between(const Homogeneous& a, const Homogeneous& b) { return (a - b).matrix().norm(); }

/// Every pair of degrees, in the middle, on the sides and at the corners.
TEST(TaylorForm, IsThePolynomialOfItsControlNet) {
  std::mt19937_64 random(2718);
  for (std::uint32_t p = 1; p <= kMaxDegree; ++p) {
    for (std::uint32_t q = 1; q <= kMaxDegree; ++q) {
      std::vector<double> net(4 * (p + 1) * (q + 1));
      for (double& coordinate : net) coordinate = uniform(random, -1, 1);
      std::vector<double> form = net;
      to_taylor_form(p, q, form.data());
      for (const auto& [s, t] :
           {std::array{0.5, 0.5}, {0.0, 0.0}, {1.0, 0.0}, {0.3, 1.0}, {uniform(random, 0, 1), 0.7}}) {
        HomogeneousDerivatives found;
        evaluate_taylor(form.data(), p, q, s - 0.5, t - 0.5, found);
        const HomogeneousDerivatives expected = bernstein_sum(net.data(), p, q, s, t);
        const double rounding = 1e-14 * static_cast<double>(p * q) * std::pow(2.0, p + q);
        EXPECT_LT(distance_between(found.a, expected.a), rounding) << p << " x " << q;
        EXPECT_LT(distance_between(found.a_u, expected.a_u), p * rounding) << p << " x " << q;
        EXPECT_LT(distance_between(found.a_v, expected.a_v), q * rounding) << p << " x " << q;
        EXPECT_LT(distance_between(found.a_uu, expected.a_uu), p * p * rounding) << p << " x " << q;
        EXPECT_LT(distance_between(found.a_uv, expected.a_uv), p * q * rounding) << p << " x " << q;
        EXPECT_LT(distance_between(found.a_vv, expected.a_vv), q * q * rounding) << p << " x " << q;
      }
    }
  }
}

bool within(const SurfacePlace& p, const ParameterLimits& l) {
  return p.u >= l.u_min && p.u <= l.u_max && p.v >= l.v_min && p.v <= l.v_max;
}

class NewtonWalk : public ::testing::TestWithParam<std::string> {};

/// From places near and far, with limits and without: what is called a foot is a local minimum inside the limits;
/// where it is none, the start has come no farther from the point and lies in the limits still.
TEST_P(NewtonWalk, EndsAtALocalMinimumOrNoFartherOff) {
  const Surface& surface = reference_design(GetParam()).surface();
  const double size = surface.half_diagonal();
  std::mt19937_64 random(31);
  int feet = 0, others = 0;
  for (int k = 0; k < 4000; ++k) {
    SurfacePlace start = random_place(surface, random);
    const Vec3 r = surface.evaluate(start).s + size * std::pow(10.0, uniform(random, -6, -0.5)) * random_vector(random);
    const double narrow = uniform(random, 0, 0.1);
    const ParameterLimits limits = k % 2 == 0
                                       ? ParameterLimits()
                                       : ParameterLimits{start.u - narrow * start.u, start.u + narrow * (1 - start.u),
                                                         start.v - narrow * start.v, start.v + narrow * (1 - start.v)};
    const double before = (r - surface.evaluate(start).s).norm();
    Projection foot;
    if (newton_walk(surface, r, limits, start, foot)) {
      ++feet;
      ASSERT_TRUE(within(foot.place, limits));
      const SurfacePoint at = surface.evaluate(foot.place);
      const Vec3 offset = r - at.s;
      EXPECT_LE(offset.norm(), before + 1e-12 * size);
      EXPECT_LT(std::abs(offset.dot(at.s_u.normalized())), 1e-11 * size);
      EXPECT_LT(std::abs(offset.dot(at.s_v.normalized())), 1e-11 * size);
      EXPECT_LT((foot.at.s - at.s).norm(), 1e-12 * size);
      EXPECT_LT((foot.at.s_u - at.s_u).norm(), 1e-6 * at.s_u.norm());
      const double h_uu = at.s_u.squaredNorm() - offset.dot(at.s_uu), h_vv = at.s_v.squaredNorm() - offset.dot(at.s_vv);
      const double h_uv = at.s_u.dot(at.s_v) - offset.dot(at.s_uv);
      EXPECT_TRUE(h_uu > 0.0 && h_uu * h_vv > h_uv * h_uv);
    } else {
      ++others;
      ASSERT_TRUE(within(start, limits));
      EXPECT_LE((r - surface.evaluate(start).s).norm(), before + 1e-12 * size);
    }
  }
  EXPECT_GT(feet, 400);
  EXPECT_GT(others, 400);
}

INSTANTIATE_TEST_SUITE_P(AllCases, NewtonWalk, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& param) { return param.param; });

}  // namespace
}  // namespace bladefit::testing
