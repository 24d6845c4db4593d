#include "tools/design/nurbs/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "tools/design/nurbs/facets.hpp"

namespace bladefit {
namespace {

/// Points of an edge, at even steps of its parameter.
constexpr std::size_t kPoints = 129;
/// The points of an edge that are looked at are so many apart.
constexpr std::size_t kStep = 16;

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

/// At even steps of the way in (u, v): of its straight pieces one may be as long as all others.
Edge edge_along(const BezierPatch& patch, const TrimSide& side) {
  std::vector<double> way = {0};
  for (std::size_t i = 1; i < side.size(); ++i) {
    way.push_back(way.back() + std::hypot(side[i].u - side[i - 1].u, side[i].v - side[i - 1].v));
  }
  Edge edge;
  std::size_t i = 0;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double wanted = way.back() * static_cast<double>(k) / (kPoints - 1);
    while (i + 2 < side.size() && way[i + 1] < wanted) ++i;
    const double length = way[i + 1] - way[i];
    const double share = length > 0 ? std::clamp((wanted - way[i]) / length, 0.0, 1.0) : 0.0;
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

/// The distance from the cubic through the points `i` - 1 and `i` of an edge with the directions of its neighbours
/// (Catmull-Rom), by straight pieces of it: chords of a bent edge are too far off.
double distance_to_cubic(const Eigen::Vector3d& point, const Edge& line, std::size_t i) {
  constexpr int kPieces = 8;
  const Eigen::Vector3d &b = line[i - 1], &c = line[i];
  const Eigen::Vector3d a = i > 1 ? line[i - 2] : Eigen::Vector3d(2 * b - c),
                        d = i + 1 < kPoints ? line[i + 1] : Eigen::Vector3d(2 * c - b);
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d last = b;
  for (int k = 1; k <= kPieces; ++k) {
    const double t = static_cast<double>(k) / kPieces;
    const Eigen::Vector3d next =
        b + 0.5 * t * ((c - a) + t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * (b - c) + d - a)));
    least = std::min(least, distance(point, last, next));
    last = next;
  }
  return least;
}

double distance_to_outline(const Eigen::Vector3d& point, const Outline& outline) {
  double least = std::numeric_limits<double>::infinity();
  const Edge* nearest = nullptr;
  std::size_t at = 1;
  for (const Edge& line : outline.edges) {
    for (std::size_t i = 1; i < kPoints; ++i) {
      const double here = distance(point, line[i - 1], line[i]);
      if (here >= least) continue;
      least = here;
      nearest = &line;
      at = i;
    }
  }
  return nearest == nullptr ? least : std::min(least, distance_to_cubic(point, *nearest, at));
}

/// The largest distance of an edge from the outline; nothing where it is over `reach_mm`, or the edge is a point.
std::optional<double> gap(const Edge& edge, const Outline& other, double reach_mm) {
  if ((edge.front() - edge[kPoints / 2]).norm() <= reach_mm) return std::nullopt;
  double largest = 0;
  for (std::size_t k = kStep; k + kStep < kPoints; k += kStep) {
    largest = std::max(largest, distance_to_outline(edge[k], other));
    if (largest > reach_mm) return std::nullopt;
  }
  return largest;
}

std::vector<Outline> outlines_of(const std::vector<NurbsSurface>& surfaces) {
  std::vector<Outline> outlines;
  outlines.reserve(surfaces.size());
  for (const NurbsSurface& surface : surfaces) outlines.push_back(outline_of(surface));
  return outlines;
}

/// All along the edge some other face is within `closed_mm`: here this one, there that.
bool is_closed(const Edge& edge, std::size_t own, const std::vector<Outline>& outlines, double closed_mm) {
  for (std::size_t k = kStep; k + kStep < kPoints; k += kStep) {
    bool beside = false;
    for (std::size_t other = 0; other < outlines.size() && !beside; ++other) {
      if (other == own || outlines[other].box.exteriorDistance(edge[k]) > closed_mm) continue;
      beside = distance_to_outline(edge[k], outlines[other]) <= closed_mm;
    }
    if (!beside) return false;
  }
  return true;
}

/// The pairs whose edges, of those that each outline has, run side by side; whole outlines are what they run along.
std::vector<Neighbours> pairs_beside(const std::vector<std::vector<Edge>>& edges, const std::vector<Outline>& outlines,
                                     double reach_mm) {
  std::vector<Neighbours> found;
  for (std::size_t a = 0; a < outlines.size(); ++a) {
    for (std::size_t b = a + 1; b < outlines.size(); ++b) {
      if (outlines[a].box.exteriorDistance(outlines[b].box) > reach_mm) continue;
      std::optional<double> least;
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        for (const Edge& edge : edges[from]) {
          if (const auto one = gap(edge, outlines[to], reach_mm); one && (!least || *one < *least)) least = one;
        }
      }
      if (least) found.push_back({a, b, *least});
    }
  }
  return found;
}

}  // namespace

std::vector<Neighbours> find_neighbours(const std::vector<NurbsSurface>& surfaces, double reach_mm) {
  const std::vector<Outline> outlines = outlines_of(surfaces);
  std::vector<std::vector<Edge>> edges;
  edges.reserve(outlines.size());
  for (const Outline& outline : outlines) edges.push_back(outline.edges);
  return pairs_beside(edges, outlines, reach_mm);
}

std::vector<Neighbours> find_gaps(const std::vector<NurbsSurface>& surfaces, double closed_mm, double reach_mm) {
  const std::vector<Outline> outlines = outlines_of(surfaces);
  std::vector<std::vector<Edge>> open(outlines.size());
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    for (const Edge& edge : outlines[k].edges) {
      if (!is_closed(edge, k, outlines, closed_mm)) open[k].push_back(edge);
    }
  }
  std::vector<Neighbours> gaps = pairs_beside(open, outlines, reach_mm);
  std::erase_if(gaps, [closed_mm](const Neighbours& pair) { return pair.gap_mm <= closed_mm; });
  return gaps;
}

}  // namespace bladefit
