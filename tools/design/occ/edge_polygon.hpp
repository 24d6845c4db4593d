#pragma once
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>

#include <Eigen/Core>
#include <vector>

#include "tools/design/occ/face_loops.hpp"

namespace bladefit {

/// What is nearer to a side of the box than this share of it lies on it: boundary curves are approximations.
inline constexpr double kOnSide = 1e-4;

/// One bounding curve of a face as a polygon in the parameters of the box of its spline, 0..1, in the sense of the
/// loop.
struct EdgePolygon {
  std::vector<Eigen::Vector2d> places;
  Eigen::Vector3d first_way, last_way;  ///< unit tangents in space at its ends; zero where it is a point
  Eigen::Vector3d from, to;             ///< its ends, before the placement
  double off = 0;                       ///< how far it was seen to be off its curve, before the placement
};

/// A bounding curve as a file gives it: in the parameters of the surface, and in space, which counts where both do not
/// agree, but along the sides of the box: it is the one that the neighbouring face shares.
struct EdgeCurves {
  Handle(Geom2d_Curve) flat;
  Handle(Geom_Curve) space;  ///< of the same parameter, before the placement; may be null
  double first = 0, last = 0;
  bool reversed = false;  ///< the loop runs against them
};

/// `tolerance`: before the placement. A curve in space that is over a thousand tolerances off counts as another one.
[[nodiscard]] EdgePolygon edge_polygon(const EdgeCurves& edge, const FaceBasis& basis, double tolerance);

}  // namespace bladefit
