#pragma once
#include <vector>

#include "tools/design/image/leaf_bounding.hpp"
#include "tools/design/image/tree_builder.hpp"

namespace bladefit {

/// A rectangle of a span as a leaf, and what it is cut into where there is room for more.
struct LeafCandidate {
  ImageLeaf leaf{};  ///< `span` and `node` are left open
  Box box{};         ///< of its control points [mm]
  double gain = 0;   ///< how much is gained by cutting it, against others of the design; 0: it is not to be cut
  int cuts = 0;
  std::size_t halves = 0;  ///< number of the first of its halves; 0: none
  bool on_face = true;     ///< false: it lies outside of the trim loops, and is left out
};

/// The candidates of a span: the first is the whole span, halves follow what they are halves of.
using LeafTree = std::vector<LeafCandidate>;

/// Cuts a Bezier span by halves, until the bounds of each tell that the distance from every point near to it is convex
/// over it, at most 2^kLeafCuts of them. `near` [mm] is how far off the surface that is wanted.
inline constexpr int kLeafCuts = 6;
[[nodiscard]] LeafTree cut_into_leaves(const BezierSpan& span, double near);

/// The whole span as one leaf, for a small image: the search cuts it into pieces itself, each time. Hair-thin spans are
/// cut as above, since along them that would take too many.
[[nodiscard]] LeafTree keep_as_leaf(const BezierSpan& span, double near);

}  // namespace bladefit
