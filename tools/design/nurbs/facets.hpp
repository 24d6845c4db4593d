#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "tools/design/nurbs/bezier_extraction.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// Point of a Bezier patch at the normalised parameters, by de Casteljau.
[[nodiscard]] Eigen::Vector3d point_of(const BezierPatch& patch, double u, double v);

/// A triangle between points of a surface; a, b, c turn about Su x Sv.
struct Facet {
  Eigen::Vector3d a, b, c;

  [[nodiscard]] Eigen::Vector3d centre() const { return (a + b + c) / 3; }
  /// Along Su x Sv; its length is twice the area.
  [[nodiscard]] Eigen::Vector3d cross() const { return (b - a).cross(c - a); }
  [[nodiscard]] double area() const { return cross().norm() / 2; }
};

/// Facets of surfaces, those of surface k from first[k] up to first[k + 1].
struct FacetedSurfaces {
  std::vector<Facet> facets;
  std::vector<std::size_t> first = {0};
};

/// Two facets for every cell of at least 32 x 32 places of each surface, fewer where there are more than ten surfaces;
/// knots are among them.
[[nodiscard]] FacetedSurfaces faceted(const std::vector<NurbsSurface>& surfaces);

/// The facets between points at every pair of parameters; at(u, v) is a point. Those whose middle keep(u, v) does not
/// want are left out, unless it wants none.
template <class At, class Keep>
void append_facets(const std::vector<double>& us, const std::vector<double>& vs, At at, Keep keep,
                   std::vector<Facet>& facets) {
  std::vector<Eigen::Vector3d> points;
  for (const double u : us) {
    for (const double v : vs) points.push_back(at(u, v));
  }
  const auto point = [&](std::size_t i, std::size_t j) { return points[i * vs.size() + j]; };
  std::vector<Facet> all, kept;
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      all.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      if (keep((us[i] + 2 * us[i + 1]) / 3, (2 * vs[j] + vs[j + 1]) / 3)) kept.push_back(all.back());
      all.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
      if (keep((2 * us[i] + us[i + 1]) / 3, (vs[j] + 2 * vs[j + 1]) / 3)) kept.push_back(all.back());
    }
  }
  const std::vector<Facet>& wanted = kept.empty() ? all : kept;
  facets.insert(facets.end(), wanted.begin(), wanted.end());
}

}  // namespace bladefit
