#include "tools/design/nurbs/facets.hpp"

#include <algorithm>
#include <cmath>

#include "tools/design/nurbs/trim_loops.hpp"

namespace bladefit {
namespace {

/// Facets a surface is divided into, in each direction, at least; spans with more knots get one a span.
constexpr std::size_t kMostParts = 32, kLeastParts = 6;
/// Facets of all surfaces together, about.
constexpr double kFacets = 20000;

/// Parameters of the facet corners: every break (or some, where there are hundreds), and points between.
std::vector<double> facet_parameters(const std::vector<double>& breaks, std::size_t least) {
  const std::size_t spans = breaks.size() - 1;
  const std::size_t parts = (least + spans - 1) / spans;
  const std::size_t stride = (spans + 2 * least - 1) / (2 * least);
  std::vector<double> parameters;
  for (std::size_t k = 0; k < spans; k += stride) {
    const double next = breaks[std::min(k + stride, spans)];
    for (std::size_t part = 0; part < parts; ++part) {
      parameters.push_back(breaks[k] + (next - breaks[k]) * static_cast<double>(part) / static_cast<double>(parts));
    }
  }
  parameters.push_back(1.0);
  return parameters;
}

}  // namespace

Eigen::Vector3d point_of(const BezierPatch& patch, double u, double v) {
  const auto locate = [](const std::vector<double>& breaks, double t) {
    const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
    return static_cast<std::size_t>(above - breaks.begin()) - 1;
  };
  const auto reduce = [](std::vector<Eigen::Vector4d> points, double t) {
    for (std::size_t last = points.size() - 1; last > 0; --last) {
      for (std::size_t k = 0; k < last; ++k) points[k] = (1 - t) * points[k] + t * points[k + 1];
    }
    return points.front();
  };
  const std::size_t iu = locate(patch.breaks_u, u);
  const std::size_t iv = locate(patch.breaks_v, v);
  const double s = (u - patch.breaks_u[iu]) / (patch.breaks_u[iu + 1] - patch.breaks_u[iu]);
  const double t = (v - patch.breaks_v[iv]) / (patch.breaks_v[iv + 1] - patch.breaks_v[iv]);
  const double* net = &patch.coefficients[(iu * patch.spans_v() + iv) * patch.span_size()];
  std::vector<Eigen::Vector4d> column;
  for (int i = 0; i <= patch.degree_u; ++i) {
    std::vector<Eigen::Vector4d> row;
    for (int j = 0; j <= patch.degree_v; ++j) row.emplace_back(net + 4 * (i * (patch.degree_v + 1) + j));
    column.push_back(reduce(row, t));
  }
  const Eigen::Vector4d point = reduce(column, s);
  return point.head<3>() / point.w();
}

FacetedSurfaces faceted(const std::vector<NurbsSurface>& surfaces) {
  const auto even = static_cast<std::size_t>(std::sqrt(kFacets / 2 / static_cast<double>(surfaces.size())));
  const std::size_t least = std::clamp(even, kLeastParts, kMostParts);
  FacetedSurfaces result;
  for (const NurbsSurface& surface : surfaces) {
    const BezierPatch patch = extract_bezier(surface);
    append_facets(
        facet_parameters(patch.breaks_u, least), facet_parameters(patch.breaks_v, least),
        [&patch](double u, double v) { return point_of(patch, u, v); },
        [&surface](double u, double v) { return inside_loops(surface.trims, u, v); }, result.facets);
    result.first.push_back(result.facets.size());
  }
  return result;
}

}  // namespace bladefit
