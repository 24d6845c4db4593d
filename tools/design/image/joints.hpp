#pragma once
#include <cstddef>
#include <vector>

namespace bladefit {

/// Marks the joints of a sealed image, in place: parts of the sides of patches along which another patch, or the same
/// one again, begins within joint_gap(), whatever the angle, the order of the patches and the directions of their
/// parameters; and creases inside patches. Three places of each part must agree. Leaves the image unsealed.
/// Marks also outer edges that face another one across the material. A side that is a point, and sides of patches whose
/// normals disagree on where the material is, are none. Pieces of trim loops are marked in the same way. Cost: some
/// microseconds a place, 48 places a knot span along an edge.
void mark_joints(std::vector<std::byte>& image);

}  // namespace bladefit
