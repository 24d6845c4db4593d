#include "core/geometry/nearest/global_projection.hpp"

#include <array>
#include <span>

#include "core/geometry/nearest/bounding_tree.hpp"
#include "core/geometry/nearest/leaf_search.hpp"
#include "core/geometry/nearest/trim_search.hpp"

namespace bladefit {
namespace {

/// Children of a node that are still to be looked at, the nearest on top.
class Pending {
 public:
  struct Entry {
    float square;
    std::uint32_t child;
  };
  [[nodiscard]] bool empty() const { return size_ == 0; }
  Entry pop() { return stack_[--size_]; }

  /// Takes those of a node's children that are nearer than the threshold.
  void push(const ImageNode& node, const BoxDistances::Four& squares, float threshold) {
    const std::size_t first = size_;
    for (int k = 0; k < 4; ++k) {
      if (!(squares[k] < threshold)) continue;
      std::size_t place = size_++;
      for (; place > first && stack_[place - 1].square < squares[k]; --place) stack_[place] = stack_[place - 1];
      stack_[place] = {squares[k], node.child[k]};
    }
  }

 private:
  std::array<Entry, 3 * kMaxTreeDepth + 4> stack_;
  std::size_t size_ = 0;
};

/// Leaves and runs whose share of the pieces was used up before the nearest was found: with that they may be settled at
/// once.
class Unfinished {
 public:
  struct Entry {
    std::uint32_t child;
    double limit;  ///< of the search then [mm]
  };
  /// False where there is no room.
  bool note(std::uint32_t child, double limit) {
    if (size_ == entries_.size()) return false;
    entries_[size_++] = {child, limit};
    return true;
  }
  [[nodiscard]] std::span<const Entry> entries() const { return {entries_.data(), size_}; }

 private:
  std::array<Entry, 16> entries_;
  std::size_t size_ = 0;
};

/// Depth first, the nearest child first.
GlobalProjection search(const Surface& surface, const ProjectionQuery& query, const Projection* hint) {
  NearestSoFar nearest(surface, query);
  if (hint != nullptr) nearest.consider(*hint);
  const BoxDistances boxes(query.point - surface.middle());
  const ImageNode* nodes = surface.image().nodes().data();
  const auto leaves = static_cast<std::uint32_t>(surface.image().leaves().size());
  float threshold = boxes.threshold(nearest.limit());
  Pending pending;
  pending.push(nodes[0], boxes.squares(nodes[0]), threshold);
  std::uint32_t pieces = 0;
  bool exhausted = false;
  const auto look_at = [&](std::uint32_t index) {
    const std::uint32_t budget = kMaxPieces - pieces;
    const LeafOutcome outcome = index < leaves ? search_leaf(surface, query, index, budget, nearest)
                                               : search_run(surface, query.point, index - leaves, budget, nearest);
    pieces += outcome.pieces;
    return outcome;
  };
  Unfinished unfinished;
  while (!pending.empty() && pieces < kMaxPieces) {
    const auto [square, child] = pending.pop();
    if (!(square < threshold)) continue;
    if ((child & kLeafChild) == 0) {
      pending.push(nodes[child], boxes.squares(nodes[child]), threshold);
      continue;
    }
    const std::uint32_t index = child & ~kLeafChild;
    if (look_at(index).exhausted && !unfinished.note(index, nearest.limit())) exhausted = true;
    threshold = boxes.threshold(nearest.limit());
  }
  for (const auto& [index, limit] : unfinished.entries()) {
    const bool nearer = nearest.limit() < limit && pieces < kMaxPieces;
    if (!nearer || look_at(index).exhausted) exhausted = true;
  }
  return nearest.result(exhausted || !pending.empty(), pieces);
}

}  // namespace

bool faces_probe(const Surface& surface, const Projection& projection, const Vec3& approach) {
  return approach.squaredNorm() < 0.5 || faces_probe(surface.outward(projection.place, projection.at), approach);
}

GlobalProjection project_global(const Surface& surface, const ProjectionQuery& query, const Projection* hint) {
  GlobalProjection directed = search(surface, query, hint);
  if (directed.nearest.converged || query.approach.isZero()) return directed;
  const ProjectionQuery undirected{query.point, Vec3::Zero(), query.margin};
  GlobalProjection any = search(surface, undirected, hint);
  any.proven = any.proven && !directed.exhausted;
  if (!any.proven) any.runner_up = RunnerUp();
  any.pieces += directed.pieces;
  any.faces = false;
  return any;
}

}  // namespace bladefit
