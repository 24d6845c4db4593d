#pragma once
#include <span>
#include <vector>

#include "core/inspection/tolerance_map.hpp"
#include "tools/show/face_mesh.hpp"

namespace bladefit {

/// What is allowed at the leading edge between two radii.
struct EdgeLimits {
  double low_mm = 0, high_mm = 0;  ///< radii
  Limits limits;
};

/// The limits of the leading edge from root to tip, as far as zones of it reach: pieces that do not overlap, of the
/// first zone at each radius. Empty in a map without zones. `zones`: the part of the design in each box of the map, in
/// its order, from whose grid the radii are taken. Cost: linear in the points of the grids.
[[nodiscard]] std::vector<EdgeLimits> edge_limits(const ToleranceMap& map, std::span<const FaceMesh> zones);

}  // namespace bladefit
