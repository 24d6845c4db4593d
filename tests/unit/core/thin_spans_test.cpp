// Lofts with knots at very uneven distances: spans that are hair-thin, and sheared. Every foot is the nearest and
// proven. Where control points are noisier than their spans are wide (0.01 mm beside 6e-8 mm) the surface folds over
// itself: there it has no one normal, and a foot may be told as not proven.

#include <gtest/gtest.h>

#include <random>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/compiled_design.hpp"
#include "tests/support/random_places.hpp"
#include "tools/design/image/image_writer.hpp"

namespace bladefit::testing {
namespace {

constexpr double kOff = 1e-9;  ///< no foot is farther than the nearest by more than this [half diagonals]

struct Loft {
  int spans;
  double least;      ///< the thinnest spans, of the range
  double noise_mm;   ///< of the control points
  bool turned;       ///< the thin way is v
  int unproven = 0;  ///< feet in 600 that may be told as not proven
};

/// Spans whose widths are spread over the decades from `least` to 1.
SurfaceDirection uneven(const Loft& loft, std::mt19937_64& random) {
  SurfaceDirection direction;
  direction.degree = 3;
  std::vector<double> inner;
  for (double at = 0.0; static_cast<int>(inner.size()) < loft.spans;) {
    at += std::pow(10.0, uniform(random, std::log10(loft.least), -1.0));
    inner.push_back(at);
  }
  const double end = inner.back();
  direction.knots.assign(4, 0.0);
  for (std::size_t k = 0; k + 1 < inner.size(); ++k) direction.knots.push_back(inner[k] / end);
  direction.knots.insert(direction.knots.end(), 4, 1.0);
  direction.control_points = loft.spans + 3;
  direction.end = 1.0;
  return direction;
}

/// A wavy sheet of 60 mm, 30 mm wide and sheared by 75 mm over that.
NurbsSurface sheared(const Loft& loft, std::mt19937_64& random) {
  NurbsSurface surface;
  surface.name = "loft";
  surface.u = uneven(loft, random);
  surface.v = {2, 4, {0, 0, 0, 0.5, 1, 1, 1}, 0.0, 1.0};
  const std::array<double, 4> across = {0.0, 0.25, 0.75, 1.0};
  for (int i = 0; i < surface.u.control_points; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double t = (surface.u.knots[k + 1] + surface.u.knots[k + 2] + surface.u.knots[k + 3]) / 3.0;
    for (const double w : across) {
      const Vec3 noise = loft.noise_mm * random_direction_in_space(random);
      surface.control_points.emplace_back(60 * t + 75 * w + noise[0], 30 * w, 4 * std::sin(3 * t) + w * w + noise[2]);
    }
  }
  surface.weights.assign(surface.control_points.size(), 1.0);
  if (!loft.turned) return surface;
  NurbsSurface turned = surface;
  std::swap(turned.u, turned.v);
  for (int i = 0; i < surface.u.control_points; ++i) {
    for (int j = 0; j < 4; ++j) {
      turned.control_points[static_cast<std::size_t>(j * surface.u.control_points + i)] =
          surface.control_points[static_cast<std::size_t>(i * 4 + j)];
    }
  }
  return turned;
}

/// The nearest of many places of the spans about those that are nearest.
double sampled(const Surface& surface, const Vec3& r) {
  constexpr int kAlong = 400, kAcross = 3;
  double least = INFINITY;
  for (std::uint32_t span = 0; span < surface.image().spans().size(); ++span) {
    const SpanDomain d = surface.domain(span);
    const bool thin_u = d.u_max - d.u_min < d.v_max - d.v_min;
    const int nu = thin_u ? kAcross : kAlong, nv = thin_u ? kAlong : kAcross;
    for (int i = 0; i <= nu; ++i) {
      for (int j = 0; j <= nv; ++j) {
        const SurfacePlace place{span, d.u_min + (d.u_max - d.u_min) * i / nu, d.v_min + (d.v_max - d.v_min) * j / nv};
        least = std::min(least, (surface.evaluate(place).s - r).norm());
      }
    }
  }
  return least;
}

class ThinSpans : public ::testing::TestWithParam<Loft> {};

TEST_P(ThinSpans, FeetAreNearestAndProven) {
  constexpr int kSurfaces = 4, kPoints = 150;
  std::uint32_t most = 0;
  int unproven = 0, wrong = 0;
  for (std::uint64_t seed = 1; seed <= kSurfaces; ++seed) {
    std::mt19937_64 random(seed);
    const CompiledDesign design(write_image({sheared(GetParam(), random)}, DesignUnit::mm, 1));
    const Surface& surface = design.surface();
    for (int k = 0; k < kPoints; ++k) {
      const SurfacePlace place = random_place(surface, random);
      const SurfacePoint at = surface.evaluate(place);
      const double height = std::pow(10.0, uniform(random, -4, 0.5));
      const Vec3 r = at.s + height * (k % 5 == 0 ? random_direction_in_space(random) : surface.normal(place, at));
      const GlobalProjection found = project_global(surface, {r}, nullptr);
      const double distance = found.nearest.offset.norm(), off = kOff * design.size();
      most = std::max(most, found.pieces);
      if (!found.proven) ++unproven;
      if (distance > height + off || (k % 15 == 0 && distance > sampled(surface, r) + off)) ++wrong;
    }
  }
  std::printf("[ figures  ] at most %u pieces\n", most);
  EXPECT_LE(unproven, GetParam().unproven);
  EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Lofts, ThinSpans,
                         ::testing::Values(Loft{60, 1e-9, 0.0, false}, Loft{60, 1e-9, 1e-4, false},
                                           Loft{120, 1e-9, 0.01, false}, Loft{60, 1e-6, 1e-4, true},
                                           Loft{120, 1e-9, 1e-3, true}, Loft{120, 1e-9, 0.01, true, 1}));

}  // namespace
}  // namespace bladefit::testing
