#pragma once
#include <string>
#include <vector>

#include "core/geometry/surface/surface.hpp"
#include "core/inspection/tolerance_map.hpp"

namespace bladefit {

/// Part of a patch as a grid of points that are dense where it bends.
struct FaceMesh {
  std::uint32_t patch = 0;
  std::vector<double> us, vs;  ///< parameters of the lines of the grid, rising
  std::vector<Vec3> points;    ///< [mm]; that at (us[i], vs[j]) at i * vs.size() + j
  std::vector<Vec3> normals;   ///< outward unit normals, in the same order
  std::uint32_t zone = 0;      ///< of the tolerance map that the part is of, from 1; 0: of none
};

/// `count` parameters from 0 to 1 along u, or along v: half of them by length, half by how much the patch bends.
[[nodiscard]] std::vector<double> mesh_parameters(const Surface& surface, std::uint32_t patch, bool along_u,
                                                  std::size_t count);

/// The grid over these parameters. Cost: one evaluation a point.
[[nodiscard]] FaceMesh mesh_over(const Surface& surface, std::uint32_t patch, std::vector<double> us,
                                 std::vector<double> vs);

/// The part of a face's grid in a box of its parameters, whose limits are lines of it: both lie on each other.
[[nodiscard]] FaceMesh mesh_inside(const Surface& surface, const FaceMesh& face, const ParameterBox& box);

/// Every patch, so dense that all have no more than some 60,000 points together.
[[nodiscard]] std::vector<FaceMesh> mesh_faces(const Surface& surface);

}  // namespace bladefit
