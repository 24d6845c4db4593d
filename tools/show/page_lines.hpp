#pragma once
#include <string>
#include <vector>

#include "core/inspection/shaft_axis.hpp"
#include "tools/design/ridge/blade_ridges.hpp"
#include "tools/show/face_mesh.hpp"

namespace bladefit {

/// What a line on the design is.
enum class LineKind { edge, constant_u, constant_v, ring, ridge };

/// A line on the design, in pieces of two ends each, and what stands beside it.
struct PageLine {
  LineKind kind = LineKind::edge;
  std::uint32_t patch = 0;
  std::string label;                 ///< may be empty
  std::vector<Vec3> ends;            ///< [mm]; two a piece
  Vec3 label_place = Vec3::Zero();   ///< [mm]
  Vec3 label_normal = Vec3::Zero();  ///< the label is to be seen from this side; 0: from all sides
};

/// The four edges of a mesh of a whole patch, and its lines of constant u and v at multiples of `step`.
[[nodiscard]] std::vector<PageLine> iso_lines(const Surface& surface, const FaceMesh& mesh, double step);

/// Where the mesh is at a multiple of 0.1 of `tip_radius_mm` from the axis: one line for each such radius.
[[nodiscard]] std::vector<PageLine> ring_lines(const FaceMesh& mesh, const ShaftAxis& axis, double tip_radius_mm);

/// The ridges of a blade.
[[nodiscard]] std::vector<PageLine> ridge_lines(const RidgedBlade& blade);

}  // namespace bladefit
