#pragma once
#include <vector>

#include "tools/show/face_mesh.hpp"

namespace bladefit {

/// The parts of a face that lie in zones of a tolerance map, by cells of its grid, into which the limits of their boxes
/// are added: a cell belongs to the zone of its middle, so that a limit by radius is off by half a cell at most. Cost:
/// an evaluation a cell.
[[nodiscard]] std::vector<FaceMesh> mesh_zones(const Surface& surface, const FaceMesh& face, const ToleranceMap& map);

}  // namespace bladefit
