#pragma once
#include <Geom2d_Curve.hxx>

#include <Eigen/Core>
#include <vector>

#include "tools/design/occ/face_loops.hpp"

namespace bladefit {

/// One bounding curve of a face as a polygon in the parameters of the box of its spline, 0..1, in the sense of the loop.
struct EdgePolygon {
  std::vector<Eigen::Vector2d> places;
  Eigen::Vector3d first_way, last_way;  ///< unit tangents in space at its ends; zero where it is a point
  Eigen::Vector3d from, to;             ///< its ends, before the placement
  double off = 0;                       ///< how far it was seen to be off its curve, before the placement
};

/// `reversed`: the loop runs against the curve from `first` to `last`. `tolerance`: before the placement.
[[nodiscard]] EdgePolygon edge_polygon(const Geom2d_Curve& curve, double first, double last, bool reversed,
                                       const FaceBasis& basis, double tolerance);

}  // namespace bladefit
