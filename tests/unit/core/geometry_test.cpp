// Evaluation, restriction and walking over spans, against differences and an evaluator that shares no code with them.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/support/made_surface.hpp"
#include "tests/unit/core/bernstein.hpp"
#include "tools/design/image/image_writer.hpp"

namespace bladefit::testing {
namespace {

/// Central difference of the fourth order.
template <class F>
Vec3 difference(F f, double h) {
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}

/// Expects the derivatives at `place` to be the differences of values and of first derivatives.
void expect_derivatives(const Surface& surface, const SurfacePlace& place, double tolerance) {
  const SpanDomain d = surface.domain(place.span);
  const double hu = 2e-4 * (d.u_max - d.u_min), hv = 2e-4 * (d.v_max - d.v_min);
  const auto at_u = [&](double h) { return surface.evaluate({place.span, place.u + h, place.v}); };
  const auto at_v = [&](double h) { return surface.evaluate({place.span, place.u, place.v + h}); };
  const SurfacePoint p = surface.evaluate(place);
  const double su = tolerance / (d.u_max - d.u_min), sv = tolerance / (d.v_max - d.v_min);
  EXPECT_LT((difference([&](double h) { return at_u(h).s; }, hu) - p.s_u).norm(), su);
  EXPECT_LT((difference([&](double h) { return at_v(h).s; }, hv) - p.s_v).norm(), sv);
  EXPECT_LT((difference([&](double h) { return at_u(h).s_u; }, hu) - p.s_uu).norm(), su * su / tolerance);
  EXPECT_LT((difference([&](double h) { return at_v(h).s_v; }, hv) - p.s_vv).norm(), sv * sv / tolerance);
  EXPECT_LT((difference([&](double h) { return at_u(h).s_v; }, hu) - p.s_uv).norm(), su * sv / tolerance);
  EXPECT_LT((difference([&](double h) { return at_v(h).s_u; }, hv) - p.s_uv).norm(), su * sv / tolerance);
}

/// A place at least 2e-3 of its span away from its ends, so that differences stay inside.
SurfacePlace inner_place(const Surface& surface, std::mt19937_64& random) {
  SurfacePlace place = random_place(surface, random);
  const SpanDomain d = surface.domain(place.span);
  const double gap_u = 2e-3 * (d.u_max - d.u_min), gap_v = 2e-3 * (d.v_max - d.v_min);
  place.u = std::clamp(place.u, d.u_min + gap_u, d.u_max - gap_u);
  place.v = std::clamp(place.v, d.v_min + gap_v, d.v_max - gap_v);
  return place;
}

class EveryDegree : public ::testing::TestWithParam<int> {};

TEST_P(EveryDegree, DerivativesAreDifferencesOfValues) {
  std::mt19937_64 random(2718);
  for (const bool rational : {false, true}) {
    for (int degree_v = 1; degree_v <= 9; ++degree_v) {
      const NurbsSurface made = random_surface({GetParam(), 3}, {degree_v, 2}, rational, 11);
      const CompiledDesign design(write_image({made}, DesignUnit::mm, 1));
      for (int k = 0; k < 20; ++k) {
        SCOPED_TRACE(::testing::Message() << "degrees " << GetParam() << ", " << degree_v);
        expect_derivatives(design.surface(), inner_place(design.surface(), random), 1e-4);
      }
    }
  }
}

/// Against B-spline basis functions in extended precision.
TEST_P(EveryDegree, ValuesAreThoseOfTheBSpline) {
  std::mt19937_64 random(31415);
  for (const bool rational : {false, true}) {
    const NurbsSurface made = random_surface({GetParam(), 4}, {10 - GetParam(), 3}, rational, 12);
    const CompiledDesign design(write_image({made}, DesignUnit::mm, 1));
    for (int k = 0; k < 200; ++k) {
      const SurfacePlace place = random_place(design.surface(), random);
      const Vec3 expected = evaluate_surface(made, place.u, place.v);
      EXPECT_LT((design.surface().evaluate(place).s - expected).norm(), 1e-12 * design.size());
    }
  }
}

TEST_P(EveryDegree, RestrictedNetIsTheSamePiece) {
  std::mt19937_64 random(577);
  for (const bool rational : {false, true}) {
    const std::uint32_t p = static_cast<std::uint32_t>(GetParam()), q = 10 - p;
    const NurbsSurface made = random_surface({GetParam(), 1}, {10 - GetParam(), 1}, rational, 13);
    const CompiledDesign design(write_image({made}, DesignUnit::mm, 1));
    BezierNet whole_net;
    design.surface().net(0, whole_net);
    const double* net = whole_net.points[0].data();
    for (int k = 0; k < 100; ++k) {
      const auto ordered = [&](double& low, double& high) {
        const double ends[] = {0.0, 1.0, uniform(random, 0, 1), uniform(random, 0, 1)};
        low = ends[random() % 4];
        high = ends[random() % 4];
        if (low > high) std::swap(low, high);
      };
      LocalRect rect;
      ordered(rect.s_min, rect.s_max);
      ordered(rect.t_min, rect.t_max);
      BezierNet piece = whole_net;
      restrict_net(rect, piece);
      const double s = uniform(random, 0, 1), t = uniform(random, 0, 1);
      const HomogeneousDerivatives whole = bernstein_sum(net, p, q, rect.s_min + s * (rect.s_max - rect.s_min),
                                                         rect.t_min + t * (rect.t_max - rect.t_min));
      const HomogeneousDerivatives part = bernstein_sum(piece.points[0].data(), p, q, s, t);
      EXPECT_LT((whole.a - part.a).matrix().norm(), 1e-11 * design.size());
    }
  }
}

/// Simple knots: the surface is smooth to one order below its degree, whichever span it is evaluated in.
TEST_P(EveryDegree, NeighbouringSpansContinueEachOther) {
  std::mt19937_64 random(1618);
  for (const bool rational : {false, true}) {
    const NurbsSurface made = random_surface({GetParam(), 4}, {GetParam(), 4}, rational, 14);
    const CompiledDesign design(write_image({made}, DesignUnit::mm, 1));
    const Surface& surface = design.surface();
    for (std::uint32_t i = 0; i + 1 < 4; ++i) {
      for (std::uint32_t j = 0; j < 4; ++j) {
        const std::uint32_t left = i * 4 + j, right = left + 4;
        const SpanDomain d = surface.domain(left);
        const double v = uniform(random, d.v_min, d.v_max);
        const SurfacePoint a = surface.evaluate({left, d.u_max, v}), b = surface.evaluate({right, d.u_max, v});
        EXPECT_LT((a.s - b.s).norm(), 1e-12 * design.size());
        if (GetParam() >= 2) {
          EXPECT_LT((a.s_u - b.s_u).norm(), 1e-9 * (1.0 + a.s_u.norm()));
        }
        if (GetParam() >= 3) {
          EXPECT_LT((a.s_uu - b.s_uu).norm(), 1e-8 * (1.0 + a.s_uu.norm()));
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, EveryDegree, ::testing::Range(1, 10));

class EveryDesign : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryDesign, DerivativesAreDifferencesOfValues) {
  const CompiledDesign& design = reference_design(GetParam());
  std::mt19937_64 random(161803);
  for (int k = 0; k < 300; ++k) expect_derivatives(design.surface(), inner_place(design.surface(), random), 1e-6);
}

TEST_P(EveryDesign, SettledPlaceLiesInItsSpan) {
  const CompiledDesign& design = reference_design(GetParam());
  const Surface& surface = design.surface();
  std::mt19937_64 random(55);
  const auto in_span = [&](const SurfacePlace& place) {
    const SpanDomain d = surface.domain(place.span);
    return place.u >= d.u_min && place.u <= d.u_max && place.v >= d.v_min && place.v <= d.v_max;
  };
  for (int k = 0; k < 1000; ++k) {
    SurfacePlace place = random_place(surface, random);
    const std::uint32_t patch = surface.span(place.span).patch;
    const double ends[] = {0.0, 1.0, uniform(random, 0, 1), place.u};
    place.u = ends[random() % 4];
    place.v = ends[random() % 4];
    surface.settle(place);
    EXPECT_TRUE(in_span(place));
    EXPECT_EQ(surface.span(place.span).patch, patch);
    const SurfacePlace direct = surface.place_at(patch, place.u, place.v);
    EXPECT_TRUE(in_span(direct));
    EXPECT_LT((surface.evaluate(direct).s - surface.evaluate(place).s).norm(), 1e-12 * design.size());
  }
}

/// On a break both neighbours hold the place; it stays where it was.
TEST_P(EveryDesign, PlaceOnABreakStaysInItsSpan) {
  const Surface& surface = reference_design(GetParam()).surface();
  for (std::uint32_t span = 0; span < surface.image().spans().size(); ++span) {
    const SpanDomain d = surface.domain(span);
    for (const double u : {d.u_min, d.u_max}) {
      SurfacePlace place{span, u, d.v_max};
      surface.settle(place);
      EXPECT_EQ(place.span, span);
    }
  }
}

TEST_P(EveryDesign, NormalIsUnitAndAcrossBothTangents) {
  const Surface& surface = reference_design(GetParam()).surface();
  const ReferenceCase c = read_case(GetParam());
  std::mt19937_64 random(7);
  for (int k = 0; k < 1000; ++k) {
    const SurfacePlace place = random_place(surface, random);
    const SurfacePoint p = surface.evaluate(place);
    const Vec3 n = surface.normal(place, p);
    EXPECT_NEAR(n.norm(), 1.0, 1e-14);
    EXPECT_NEAR(n.dot(p.s_u.normalized()), 0.0, 1e-12);
    EXPECT_NEAR(n.dot(p.s_v.normalized()), 0.0, 1e-12);
    EXPECT_GT(c.normal_sign * n.dot(p.s_u.cross(p.s_v)), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, EveryDesign, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& one) { return one.param; });

/// A row of control points that fall together (a blade's tip, a cone's point): the normal there is the limit.
TEST(Surface, NormalOfADegenerateEdgeIsTheLimit) {
  NurbsSurface made = random_surface({3, 1}, {3, 1}, false, 15);
  for (int j = 0; j < 4; ++j) made.control_points[static_cast<std::size_t>(j)] = {0, 0, 0};
  const CompiledDesign design(write_image({made}, DesignUnit::mm, 1));
  const Surface& surface = design.surface();
  const SurfacePlace edge{0, 0.0, 0.4}, near{0, 1e-5, 0.4};
  const Vec3 n = surface.normal(edge, surface.evaluate(edge));
  EXPECT_NEAR(n.norm(), 1.0, 1e-14);
  EXPECT_LT((n - surface.normal(near, surface.evaluate(near))).norm(), 1e-3);
}

}  // namespace
}  // namespace bladefit::testing
