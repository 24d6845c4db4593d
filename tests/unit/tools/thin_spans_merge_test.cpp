// Knots that all but coincide: what merging them leaves of a surface.

#include "tools/design/nurbs/thin_spans.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/made_surface.hpp"

namespace bladefit::testing {
namespace {

/// The place of a surface at knot parameters.
Eigen::Vector3d at(const NurbsSurface& surface, double u, double v) {
  const Basis along_u = basis_functions(surface.u, u), along_v = basis_functions(surface.v, v);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < along_u.values.size(); ++i) {
    for (std::size_t j = 0; j < along_v.values.size(); ++j) {
      const std::size_t k =
          (along_u.first + i) * static_cast<std::size_t>(surface.v.control_points) + along_v.first + j;
      sum += static_cast<double>(along_u.values[i] * along_v.values[j]) * surface.control_points[k];
    }
  }
  return sum;
}

double farthest_apart(const NurbsSurface& a, const NurbsSurface& b) {
  double most = 0;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double u = a.u.start + (a.u.end - a.u.start) * (i + 0.37) / 200,
                   v = a.v.start + (a.v.end - a.v.start) * (j + 0.37) / 20;
      most = std::max(most, (at(a, u, v) - at(b, u, v)).norm());
    }
  }
  return most;
}

/// Sheet over these knots of degree 3, whose control points lie where a smooth surface has them.
NurbsSurface loft(std::vector<double> inner) {
  NurbsSurface surface;
  surface.name = "loft";
  surface.u.degree = 3;
  surface.u.knots = {0, 0, 0, 0};
  surface.u.knots.insert(surface.u.knots.end(), inner.begin(), inner.end());
  surface.u.knots.insert(surface.u.knots.end(), 4, 1.0);
  surface.u.control_points = static_cast<int>(inner.size()) + 4;
  surface.u.end = 1.0;
  surface.v = {2, 4, {0, 0, 0, 0.5, 1, 1, 1}, 0.0, 1.0};
  for (int i = 0; i < surface.u.control_points; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double t = (surface.u.knots[k + 1] + surface.u.knots[k + 2] + surface.u.knots[k + 3]) / 3.0;
    for (const double w : {0.0, 0.25, 0.75, 1.0})
      surface.control_points.emplace_back(60 * t + 75 * w, 30 * w, 4 * std::sin(3 * t) + w * w);
  }
  surface.weights.assign(surface.control_points.size(), 1.0);
  return surface;
}

TEST(ThinSpans, AreMergedWhereTheSurfaceDoesNotMove) {
  // A pair, six together, three at the start and two at the end.
  const NurbsSurface before = loft({1e-9, 2e-9, 3e-9, 0.2, 0.2 + 2e-9, 0.4, 0.4 + 1e-9, 0.4 + 2e-9, 0.4 + 3e-9,
                                    0.4 + 4e-9, 0.4 + 5e-9, 0.6, 0.75, 1 - 2e-9, 1 - 1e-9});
  NurbsSurface after = before;
  const MergedSpans merged = merge_thin_spans(after, 1e-5);
  EXPECT_EQ(merged.spans_u, 3 + 1 + 5 + 2);
  EXPECT_EQ(merged.spans_v, 0);
  EXPECT_LT(merged.moved_mm, 1e-5);
  EXPECT_TRUE(check_surface(after, "test").empty());
  EXPECT_EQ(after.control_points.size(), static_cast<std::size_t>(4 * after.u.control_points));
  EXPECT_EQ(after.u.control_points, before.u.control_points - 3 - 3 - 2);
  const double apart = farthest_apart(before, after);
  EXPECT_LT(apart, 1e-5);
  EXPECT_LE(apart, 2.0 * merged.moved_mm + 1e-9) << "as much as it says";
  EXPECT_EQ(after.control_points.front(), before.control_points.front());
  EXPECT_EQ(after.control_points.back(), before.control_points.back());
}

TEST(ThinSpans, StayWhereTheyMoveTheSurface) {
  // Five knots in a hair: the surface goes up and down between them.
  const NurbsSurface plain = loft({0.2, 0.4, 0.4 + 1e-9, 0.4 + 2e-9, 0.4 + 3e-9, 0.4 + 4e-9, 0.6});
  NurbsSurface wavy = plain;
  for (std::size_t j = 0; j < 4; ++j) wavy.control_points[5 * 4 + j].z() += 0.5;
  NurbsSurface left = wavy;
  EXPECT_EQ(merge_thin_spans(left, 1e-5).count(), 0);
  EXPECT_EQ(left.u.knots, wavy.u.knots);
  EXPECT_EQ(left.control_points, wavy.control_points);
}

TEST(ThinSpans, AnOrdinarySurfaceStaysAsItIs) {
  const NurbsSurface before = random_surface({3, 12}, {3, 5}, true, 7);
  NurbsSurface after = before;
  EXPECT_EQ(merge_thin_spans(after, 1.0).count(), 0);
  EXPECT_EQ(after.u.knots, before.u.knots);
  EXPECT_EQ(after.weights, before.weights);
}

}  // namespace
}  // namespace bladefit::testing
