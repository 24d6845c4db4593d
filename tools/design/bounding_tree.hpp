#pragma once
#include <vector>

#include "core/geometry/design_image.hpp"

namespace bladefit {

/// An axis-parallel box [mm].
struct Box {
  double min[3], max[3];
};

/// The binary bounding tree over `boxes` (at least one), in the order and form of the design image: each node is split
/// at the median along its longest axis, so that the depth is the logarithm of their number. Same boxes, same tree.
/// Cost: n log^2 n.
std::vector<ImageNode> build_bounding_tree(const std::vector<Box>& boxes);

}  // namespace bladefit
