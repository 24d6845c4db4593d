// What the Bernstein coefficients of a distance form claim is never contradicted by dense sampling.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "core/geometry/nearest/distance_certificate.hpp"
#include "tests/support/localizer_fixtures.hpp"
#include "tests/support/made_surface.hpp"
#include "tests/unit/core/bernstein.hpp"
#include "tools/design/image/image_writer.hpp"

namespace bladefit::testing {
namespace {

/// g = |A - w r|^2 - (bound w)^2 with its derivatives, straight from the evaluated net.
struct FormSample {
  double distance, g, g_u, g_v, g_uu, g_uv, g_vv;
};

FormSample sample(const BezierNet& net, const Vec3& r, double bound, double s, double t) {
  const HomogeneousDerivatives h = bernstein_sum(net.points[0].data(), net.degree_u, net.degree_v, s, t);
  const auto form = [&](const Homogeneous& x) {
    Homogeneous out = x;
    out.head<3>() -= x[3] * r.array();
    out[3] = bound * x[3];
    return out;
  };
  const auto product = [](const Homogeneous& a, const Homogeneous& b) {
    return (a.head<3>() * b.head<3>()).sum() - a[3] * b[3];
  };
  const Homogeneous a = form(h.a), u = form(h.a_u), v = form(h.a_v), uu = form(h.a_uu), uv = form(h.a_uv),
                    vv = form(h.a_vv);
  return {(h.a.head<3>() / h.a[3] - r.array()).matrix().norm(),
          product(a, a),
          2.0 * product(a, u),
          2.0 * product(a, v),
          2.0 * (product(u, u) + product(a, uu)),
          2.0 * (product(u, v) + product(a, uv)),
          2.0 * (product(v, v) + product(a, vv))};
}

struct Claims {
  int farther = 0, monotone = 0, convex = 0, no_minimum = 0;
};

bool positive_definite(const FormSample& g, PieceShape shape) {
  if (!shape.along_u) return !shape.along_v || g.g_vv > 0.0;
  if (!shape.along_v) return g.g_uu > 0.0;
  return g.g_uu > 0.0 && g.g_uu * g.g_vv - g.g_uv * g.g_uv > 0.0;
}

/// Samples the piece and refutes whatever it can.
void check_claims(const BezierNet& net, const Vec3& r, double bound, PieceShape shape, Claims& claims) {
  const DistanceForm form(net, r, bound);
  const MinimumProof proof = prove(form.ranges(), shape);
  const bool farther = form.farther(1e-12 * bound * bound);
  const DistanceRange range = distance_range(net, r);
  claims.farther += farther ? 1 : 0;
  claims.monotone += proof.monotone_u != 0 || proof.monotone_v != 0 ? 1 : 0;
  claims.convex += proof.convex ? 1 : 0;
  claims.no_minimum += proof.no_minimum ? 1 : 0;
  constexpr int kGrid = 12;
  const double rounding = 1e-12 * (range.most * range.most + bound * bound);
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= kGrid; ++j) {
      const FormSample g = sample(net, r, bound, double(i) / kGrid, double(j) / kGrid);
      RC_ASSERT(g.distance >= range.least - 1e-12 * range.most);
      RC_ASSERT(g.distance <= range.most * (1.0 + 1e-12));
      if (farther) {
        RC_ASSERT(g.distance >= bound * (1.0 - 1e-9));
      }
      RC_ASSERT(proof.monotone_u * g.g_u >= -rounding);
      RC_ASSERT(proof.monotone_v * g.g_v >= -rounding);
      if (proof.convex) {
        RC_ASSERT(positive_definite(g, shape));
      }
      if (proof.no_minimum) {
        RC_ASSERT(!positive_definite(g, shape));
      }
    }
  }
}

/// A random part of the span that holds a random place: sizes from the whole span to a 256th.
LocalRect random_rect(std::mt19937_64& random) {
  const double size = std::exp2(-uniform(random, 0, 8));
  const auto begin = [&] { return uniform(random, 0, 1) * (1.0 - size); };
  const double s = begin(), t = begin();
  LocalRect rect{s, s + size, t, t + size};
  switch (random() % 6) {
    case 0:
      rect.s_min = rect.s_max = static_cast<double>(random() % 2);
      break;
    case 1:
      rect.t_min = rect.t_max = static_cast<double>(random() % 2);
      break;
    default:
      break;
  }
  return rect;
}

/// A point near the piece or far from it, on any side, and a bound about its distance.
void check_random_piece(const Surface& surface, std::mt19937_64& random, Claims& claims) {
  const SurfacePlace place = random_place(surface, random);
  const LocalRect rect = random_rect(random);
  BezierNet net;
  surface.net(place.span, net);
  restrict_net(rect, net);
  const double reach = surface.half_diagonal() * std::exp2(-uniform(random, 0, 14));
  const Vec3 r = surface.evaluate(place).s + reach * random_direction_in_space(random);
  const DistanceRange range = distance_range(net, r);
  const double bound = uniform(random, 0.8 * range.least, 1.05 * range.most);
  check_claims(net, r, bound, {rect.s_min < rect.s_max, rect.t_min < rect.t_max}, claims);
}

void expect_claims_hold(const Surface& surface, const std::string& name) {
  Claims claims;
  EXPECT_TRUE(rc::check(name + ": claims hold", [&] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    for (int k = 0; k < 20; ++k) check_random_piece(surface, random, claims);
  }));
  // A certificate that never claims anything would pass as well.
  EXPECT_GT(claims.farther, 0);
  EXPECT_GT(claims.monotone, 0);
  EXPECT_GT(claims.convex, 0);
  EXPECT_GT(claims.no_minimum, 0);
}

TEST(DistanceForm, ClaimsHoldOnBlades) {
  for (const char* name : {"arl_fan", "dtmb4119", "pnsy_sub"}) {
    expect_claims_hold(reference_design(name).surface(), name);
  }
}

TEST(DistanceForm, ClaimsHoldForEveryDegree) {
  for (int degree = 1; degree <= 9; ++degree) {
    for (const bool rational : {false, true}) {
      const NurbsSurface made = random_surface({degree, 3}, {10 - degree, 3}, rational, 21);
      const CompiledDesign design(write_image({made}, DesignUnit::mm, 1));
      Claims claims;
      EXPECT_TRUE(rc::check("degree " + std::to_string(degree), [&] {
        std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
        check_random_piece(design.surface(), random, claims);
      }));
      EXPECT_GT(claims.farther + claims.monotone + claims.convex, 0);
    }
  }
}

}  // namespace
}  // namespace bladefit::testing
