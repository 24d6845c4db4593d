#pragma once
#include <vector>

#include "tools/design/image/leaf_subdivision.hpp"

namespace bladefit {

/// Of each span the numbers of the candidates that are its leaves, in the order in which they tile it.
using LeafChoice = std::vector<std::vector<std::size_t>>;

/// Whole spans, cut where most is gained as long as there are no more than `most` leaves. The same trees give the same
/// choice. Cost: n log n for n candidates.
[[nodiscard]] LeafChoice choose_leaves(const std::vector<LeafTree>& trees, std::size_t most);

/// Spans that are on the face: no choice has fewer leaves.
[[nodiscard]] std::size_t fewest_leaves(const std::vector<LeafTree>& trees);

}  // namespace bladefit
