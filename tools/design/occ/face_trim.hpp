#pragma once
#include <TopoDS_Face.hxx>

#include <Eigen/Core>
#include <vector>

namespace bladefit {

/// A rectangle of a surface's own parameters.
struct FaceBox {
  double u_min, u_max, v_min, v_max;
};

/// The bounds of a face as polylines in the parameters of its surface, one a curve of 17 points; together they close.
/// None where the face is all of its surface. OpenCASCADE's own classifier takes up to 1 ms a point.
using TrimLoops = std::vector<std::vector<Eigen::Vector2d>>;
[[nodiscard]] TrimLoops trim_loops(const TopoDS_Face& face);

/// A place lies inside of the loops: a line from it crosses them an odd number of times. True where there are none.
[[nodiscard]] bool inside_loops(const TrimLoops& loops, const Eigen::Vector2d& place);

/// The box of a face's bounds. Sides within 1e-4 of the surface's range to its natural bounds, as approximated curves
/// are, lie on them.
[[nodiscard]] FaceBox face_box(const TopoDS_Face& face);

}  // namespace bladefit
