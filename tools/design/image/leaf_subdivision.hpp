#pragma once
#include <vector>

#include "tools/design/image/leaf_bounding.hpp"

namespace bladefit {

/// Cuts a Bezier span into leaves, by halves, until the bounds of each tell that the distance from every point near to
/// it is convex over it, at most 2^kLeafCuts of them. `near` [mm] is how far off the surface that is wanted.
/// Of each leaf `span` and `node` are left open.
inline constexpr int kLeafCuts = 6;
std::vector<ImageLeaf> cut_into_leaves(const BezierSpan& span, double near);

/// The whole span as one leaf, for a small image: the search cuts it into pieces itself, each time. Hair-thin spans are
/// cut as above, since along them that would take too many.
std::vector<ImageLeaf> keep_as_leaf(const BezierSpan& span, double near);

}  // namespace bladefit
