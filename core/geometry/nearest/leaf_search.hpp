#pragma once
#include "core/geometry/nearest/nearest_so_far.hpp"

namespace bladefit {

/// Outcome of the search of one leaf.
struct LeafOutcome {
  std::uint32_t pieces = 0;  ///< cut and looked at; 0 where the leaf's bounds sufficed
  bool exhausted = false;    ///< `budget` or the smallest piece was reached: something may have been missed
};

/// Shows `nearest` every local minimum of the leaf that matters to it, or proves that there is none. The leaf's
/// bounds decide first; where they do not, the leaf is cut into pieces, at most `budget` of them, whose distance is
/// bounded by Bernstein coefficients.
[[nodiscard]] LeafOutcome search_leaf(const Surface& surface, const ProjectionQuery& query, std::uint32_t leaf,
                                      std::uint32_t budget, NearestSoFar& nearest);

}  // namespace bladefit
