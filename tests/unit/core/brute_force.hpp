#pragma once
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {

/// Nearest points the slow way: a dense grid over every patch, Newton from each of its local minima.
class BruteForce {
 public:
  BruteForce(const Surface& surface, int nodes_per_span) : surface_(surface) {
    const auto patches = static_cast<std::uint32_t>(surface.image().patches().size());
    for (std::uint32_t patch = 0; patch < patches; ++patch) grids_.push_back(make_grid(patch, nodes_per_span));
  }

  /// Feet that Newton reaches from the local minima of the grid, and from its nearest node.
  [[nodiscard]] std::vector<Projection> minima(const Vec3& r) const {
    std::vector<Projection> found;
    for (const Grid& grid : grids_) {
      distances_.resize(grid.nodes.size());
      for (std::size_t k = 0; k < grid.nodes.size(); ++k) distances_[k] = (grid.nodes[k].s - r).squaredNorm();
      for (std::size_t i = 0; i < grid.rows; ++i) {
        for (std::size_t j = 0; j < grid.columns; ++j) {
          if (!least_of_neighbours(grid, i, j)) continue;
          const Projection p = project_local(surface_, r, grid.nodes[i * grid.columns + j].place);
          if (p.converged) found.push_back(p);
        }
      }
    }
    return found;
  }

  /// Distance of the nearest of `minima` whose normal faces the probe by more than `least`; infinite without one.
  /// An approach of 0 lets all of them face.
  [[nodiscard]] double nearest_facing(const std::vector<Projection>& minima, const Vec3& approach, double least) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Projection& p : minima) {
      const bool faces = approach.isZero() || surface_.normal(p.place, p.at).dot(approach) < -least;
      if (faces) nearest = std::min(nearest, p.offset.norm());
    }
    return nearest;
  }

 private:
  struct Node {
    SurfacePlace place;
    Vec3 s;
  };
  struct Grid {
    std::size_t rows = 0, columns = 0;
    std::vector<Node> nodes;
  };

  static std::vector<double> cut(const double* breaks, std::uint32_t spans, int nodes_per_span) {
    std::vector<double> out;
    for (std::uint32_t k = 0; k < spans; ++k) {
      for (int i = 0; i < nodes_per_span; ++i)
        out.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * i / nodes_per_span);
    }
    out.push_back(1.0);
    return out;
  }

  [[nodiscard]] Grid make_grid(std::uint32_t patch, int nodes_per_span) const {
    const ImagePatch& p = surface_.image().patches()[patch];
    const double* breaks = surface_.image().breaks().data();
    const std::vector<double> us = cut(breaks + p.first_break_u, p.spans_u, nodes_per_span);
    const std::vector<double> vs = cut(breaks + p.first_break_v, p.spans_v, nodes_per_span);
    Grid grid{us.size(), vs.size(), {}};
    for (const double u : us) {
      for (const double v : vs) {
        const SurfacePlace place = surface_.place_at(patch, u, v);
        grid.nodes.push_back({place, surface_.evaluate(place).s});
      }
    }
    return grid;
  }

  [[nodiscard]] bool least_of_neighbours(const Grid& grid, std::size_t i, std::size_t j) const {
    const double here = distances_[i * grid.columns + j];
    for (std::size_t a = i > 0 ? i - 1 : 0; a <= std::min(i + 1, grid.rows - 1); ++a) {
      for (std::size_t b = j > 0 ? j - 1 : 0; b <= std::min(j + 1, grid.columns - 1); ++b) {
        if (distances_[a * grid.columns + b] < here) return false;
      }
    }
    return true;
  }

  const Surface& surface_;
  std::vector<Grid> grids_;
  mutable std::vector<double> distances_;
};

/// Normal curvatures of the surface about a place, of either sign: the larger one in size [1/mm].
inline double strongest_curvature(const Surface& surface, const SurfacePlace& place) {
  const SurfacePoint p = surface.evaluate(place);
  const Vec3 n = surface.normal(place, p);
  Eigen::Matrix2d first, second;
  first << p.s_u.dot(p.s_u), p.s_u.dot(p.s_v), p.s_u.dot(p.s_v), p.s_v.dot(p.s_v);
  second << n.dot(p.s_uu), n.dot(p.s_uv), n.dot(p.s_uv), n.dot(p.s_vv);
  const Eigen::Matrix2d shape = first.inverse() * second;
  const double half = 0.5 * shape.trace(), root = std::sqrt(std::max(0.0, half * half - shape.determinant()));
  return half < 0.0 ? half - root : half + root;
}

struct QueryPoint {
  Vec3 r;
  bool focal;  ///< about the centre of curvature, where two feet become one: the answer may be left unproven
};

/// A point to be projected: on the blade, near it, far from it, beyond its edges or corners, or about the centre of
/// curvature, where two feet become one.
inline QueryPoint random_query_point(const Surface& surface, std::mt19937_64& random) {
  const double size = surface.half_diagonal();
  SurfacePlace place = random_place(surface, random);
  const std::uint64_t kind = random() % 7;
  const bool corner = kind == 4;
  if (kind == 3 || corner) {
    const bool at_u = corner || random() % 2 == 0;
    if (at_u) place.u = static_cast<double>(random() % 2);
    if (!at_u || corner) place.v = static_cast<double>(random() % 2);
    surface.settle(place);
  }
  const SurfacePoint p = surface.evaluate(place);
  const Vec3 n = surface.normal(place, p);
  const double near = size * std::pow(10.0, uniform(random, -8, -1.5));
  switch (kind) {
    case 0:
      return {p.s, false};
    case 1:
      return {p.s + (random() % 2 == 0 ? near : -near) * n, false};
    case 2:
      return {p.s + size * uniform(random, 0, 3) * random_direction_in_space(random), false};
    case 3:
    case 4:
      return {p.s + near * random_direction_in_space(random), false};
    case 5:
      return {p.s + uniform(random, 0.5, 1.5) / strongest_curvature(surface, place) * n, true};
    default:
      return {p.s + near * random_direction_in_space(random), false};
  }
}

/// A place between two random ones where the nearest point jumps.
inline Vec3 equally_near_to_two(const Surface& surface, std::mt19937_64& random) {
  const double size = surface.half_diagonal();
  const auto foot_of = [&](const Vec3& r) { return project_global(surface, {r}, nullptr).nearest.at.s; };
  for (;;) {
    Vec3 a = random_query_point(surface, random).r, b = random_query_point(surface, random).r;
    Vec3 foot_a = foot_of(a), foot_b = foot_of(b);
    while ((a - b).norm() > 1e-7 * size) {
      const Vec3 middle = 0.5 * (a + b), foot = foot_of(middle);
      const bool nearer_a = (foot - foot_a).norm() < (foot - foot_b).norm();
      (nearer_a ? a : b) = middle;
      (nearer_a ? foot_a : foot_b) = foot;
    }
    if ((foot_a - foot_b).norm() > 1e-3 * size) return a;
  }
}

}  // namespace bladefit::testing
