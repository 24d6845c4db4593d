#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/geometry/surface/design_image.hpp"

namespace bladefit {

/// By which the weights of a surface may differ; those of real ones do by less than 100.
inline constexpr double kLargestWeightRatio = 1e6;

/// One parameter direction of a surface. Control point i weighs on the knots i .. i + degree + 1.
struct SurfaceDirection {
  int degree = 0;
  int control_points = 0;
  std::vector<double> knots;  ///< control_points + degree + 1 of them, never falling
  double start = 0, end = 0;  ///< the part that is used, inside [knots[degree], knots[control_points]]
};

/// A vertex of a trim loop, in parameters of the used part of a surface that run from 0 to 1.
struct TrimVertex {
  double u = 0, v = 0;
  bool corner = false;  ///< the loop has a corner there
};

/// A closed polygon, the last vertex before the first, with the face on its left (u to the right, v upwards).
using TrimLoop = std::vector<TrimVertex>;

/// A NURBS surface as it stands in a CAD file, with its lengths turned to mm.
struct NurbsSurface {
  std::string name;  ///< for messages, for example "entity 128 at D3 (PATCH2)"
  SurfaceDirection u, v;
  std::vector<Eigen::Vector3d> control_points;  ///< [mm]; point (i, j) at i * v.control_points + j
  std::vector<double> weights;                  ///< one a control point, in the same order
  bool reversed = false;                        ///< the face looks to the other side than Su x Sv
  std::vector<TrimLoop> trims;                  ///< none: the face is all of the surface
};

/// Checks every field of `surface` and makes knots that differ by less than 1e-12 of the range one knot, so that
/// noise in the last digits makes no sliver spans. `file` is named in messages.
/// Returns one line for each thing that was repaired (none for a clean surface).
/// Throws ToolError naming the field: degree, number of knots, falling or not finite knots, multiplicity, torn
/// surface, parameter range, control points, weights.
std::vector<std::string> check_surface(NurbsSurface& surface, const std::string& file,
                                       int highest_degree = static_cast<int>(kMaxDegree));

}  // namespace bladefit
