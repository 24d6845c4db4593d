#include "core/geometry/global_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/leaf_search.hpp"

namespace bladefit {
namespace {

double box_distance(const ImageNode& node, const Vec3& r) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({node.box_min[k] - r[k], r[k] - node.box_max[k], 0.0});
    sum += d * d;
  }
  return std::sqrt(sum);
}

/// Depth first, the nearer child first.
GlobalProjection search(const Surface& surface, const ProjectionQuery& query, const Projection* hint) {
  struct Entry {
    std::uint32_t node;
    double distance;
  };
  NearestSoFar nearest(surface, query);
  if (hint != nullptr) nearest.consider(*hint);
  const auto nodes = surface.image().nodes();
  std::array<Entry, kMaxTreeDepth + 1> stack;
  std::size_t size = 0;
  stack[size++] = {0, box_distance(nodes[0], query.point)};
  std::uint32_t pieces = 0;
  bool exhausted = false;
  while (size > 0 && pieces < kMaxPieces) {
    const Entry entry = stack[--size];
    if (entry.distance >= nearest.limit()) continue;
    const ImageNode& node = nodes[entry.node];
    if (node.right == 0) {
      const LeafOutcome outcome = search_leaf(surface, query, node.leaf, kMaxPieces - pieces, nearest);
      pieces += outcome.pieces;
      exhausted = exhausted || outcome.exhausted;
      continue;
    }
    Entry near{entry.node + 1, box_distance(nodes[entry.node + 1], query.point)};
    Entry far{node.right, box_distance(nodes[node.right], query.point)};
    if (far.distance < near.distance) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return nearest.result(exhausted || size > 0, pieces);
}

}  // namespace

bool faces_probe(const Surface& surface, const Projection& projection, const Vec3& approach) {
  if (approach.squaredNorm() < 0.5) return true;
  return surface.normal(projection.place, projection.at).dot(approach) < 0.0;
}

GlobalProjection project_global(const Surface& surface, const ProjectionQuery& query, const Projection* hint) {
  GlobalProjection directed = search(surface, query, hint);
  if (directed.nearest.converged || query.approach.isZero()) return directed;
  const ProjectionQuery undirected{query.point, Vec3::Zero(), query.margin};
  GlobalProjection any = search(surface, undirected, hint);
  any.proven = any.proven && !directed.exhausted;
  if (!any.proven) any.lead = 0.0;
  any.pieces += directed.pieces;
  any.faces = false;
  return any;
}

}  // namespace bladefit
