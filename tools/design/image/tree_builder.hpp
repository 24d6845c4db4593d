#pragma once
#include <vector>

#include "core/geometry/surface/design_image.hpp"

namespace bladefit {

/// An axis-parallel box [mm].
struct Box {
  double min[3], max[3];
};

/// The box around all.
[[nodiscard]] Box box_around(const std::vector<Box>& boxes);

/// The bounding tree over `boxes` (at least one; leaf k is that of box k), in the order and form of the design image,
/// about the middle of the box `whole`. Boxes are parted where the sum of the surface areas, weighted by the numbers of
/// boxes, is least, and at the median where that would make the tree deep; of two levels each four are joined. Same
/// boxes, same tree. Cost: n log^2 n.
[[nodiscard]] std::vector<ImageNode> build_bounding_tree(const std::vector<Box>& boxes, const Box& whole);

}  // namespace bladefit
