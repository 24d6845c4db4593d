#include "tools/design/nurbs/neighbours.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "tools/design/nurbs/facets.hpp"

namespace bladefit {
namespace {

/// Points of an edge, at even steps of its parameter.
constexpr std::size_t kPoints = 33;
/// The points of an edge that are looked at are so many apart.
constexpr std::size_t kStep = 4;

using Edge = std::array<Eigen::Vector3d, kPoints>;

struct Outline {
  std::vector<Edge> edges;
  Eigen::AlignedBox3d box;
};

/// A trim loop from one corner to the next, or as far as its vertices are points of one edge.
using TrimSide = std::vector<TrimVertex>;

std::vector<TrimSide> sides_of(const TrimLoop& loop) {
  const auto first = std::ranges::find(loop, true, &TrimVertex::corner) - loop.begin();
  std::vector<TrimSide> sides;
  for (std::size_t k = 0; k <= loop.size(); ++k) {
    const TrimVertex& vertex = loop[(static_cast<std::size_t>(first) + k) % loop.size()];
    if (!sides.empty()) sides.back().push_back(vertex);
    const bool full = !sides.empty() && sides.back().size() == kPoints;
    if (k < loop.size() && (sides.empty() || vertex.corner || full)) sides.push_back({vertex});
  }
  return sides;
}

/// At even steps of the vertices' number.
Edge edge_along(const BezierPatch& patch, const TrimSide& side) {
  Edge edge;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double place = static_cast<double>(k) / (kPoints - 1) * static_cast<double>(side.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), side.size() - 2);
    const double share = place - static_cast<double>(i);
    edge[k] = point_of(patch, (1 - share) * side[i].u + share * side[i + 1].u,
                       (1 - share) * side[i].v + share * side[i + 1].v);
  }
  return edge;
}

Outline outline_of(const NurbsSurface& surface) {
  const BezierPatch patch = extract_bezier(surface);
  Outline outline;
  for (std::size_t side = 0; side < 4 && surface.trims.empty(); ++side) {
    Edge& edge = outline.edges.emplace_back();
    for (std::size_t k = 0; k < kPoints; ++k) {
      const double share = static_cast<double>(k) / (kPoints - 1), end = side % 2 == 0 ? 0 : 1;
      edge[k] = side < 2 ? point_of(patch, end, share) : point_of(patch, share, end);
    }
  }
  for (const TrimLoop& loop : surface.trims) {
    for (const TrimSide& side : sides_of(loop)) outline.edges.push_back(edge_along(patch, side));
  }
  for (const Edge& edge : outline.edges) {
    for (const Eigen::Vector3d& point : edge) outline.box.extend(point);
  }
  return outline;
}

double distance(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double square = along.squaredNorm();
  const double share = square > 0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + share * along - point).norm();
}

/// The largest distance of an edge from the outline; nothing where it is over `reach_mm`, or the edge is a point.
std::optional<double> gap(const Edge& edge, const Outline& other, double reach_mm) {
  if ((edge.front() - edge[kPoints / 2]).norm() <= reach_mm) return std::nullopt;
  double largest = 0;
  for (std::size_t k = kStep; k + kStep < kPoints; k += kStep) {
    double least = std::numeric_limits<double>::infinity();
    for (const Edge& line : other.edges) {
      for (std::size_t i = 1; i < kPoints; ++i) least = std::min(least, distance(edge[k], line[i - 1], line[i]));
    }
    largest = std::max(largest, least);
    if (largest > reach_mm) return std::nullopt;
  }
  return largest;
}

}  // namespace

std::vector<Neighbours> find_neighbours(const std::vector<NurbsSurface>& surfaces, double reach_mm) {
  std::vector<Outline> outlines;
  outlines.reserve(surfaces.size());
  for (const NurbsSurface& surface : surfaces) outlines.push_back(outline_of(surface));
  std::vector<Neighbours> found;
  for (std::size_t a = 0; a < outlines.size(); ++a) {
    for (std::size_t b = a + 1; b < outlines.size(); ++b) {
      if (outlines[a].box.exteriorDistance(outlines[b].box) > reach_mm) continue;
      std::optional<double> least;
      for (const Edge& edge : outlines[a].edges) {
        if (const auto one = gap(edge, outlines[b], reach_mm); one && (!least || *one < *least)) least = one;
      }
      for (const Edge& edge : outlines[b].edges) {
        if (const auto one = gap(edge, outlines[a], reach_mm); one && (!least || *one < *least)) least = one;
      }
      if (least) found.push_back({a, b, *least});
    }
  }
  return found;
}

}  // namespace bladefit
