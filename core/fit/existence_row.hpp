#pragma once
#include "core/fit/motion_frame.hpp"
#include "core/geometry/nearest/local_projection.hpp"

namespace bladefit {

/// How far a foot is from where it ceases to exist, to first order in the motion parameters x: the square of
/// det(G - phi B) / det G = (1 - phi k1)(1 - phi k2), with phi the distance along the normal and k1, k2 the principal
/// curvatures. A local minimum ends where this is 0, at a centre of curvature; the foot itself moves with the root of
/// the way to there, so that the square is smooth in the pose.
struct ExistenceRow {
  double existence = 0;          ///< 1 on the surface, 0 where the foot ends
  Vec6 gradient = Vec6::Zero();  ///< [1/mm]
};

/// Of a foot inside a smooth piece of the surface at the pose x = 0. `normal`: its outward unit normal; `r`: the point.
/// Derivatives along the surface are central differences. Cost: five evaluations of the surface.
[[nodiscard]] ExistenceRow existence_row(const Surface& surface, const Projection& projection, const Vec3& normal,
                                         const Vec3& r, const MotionFrame& frame);

}  // namespace bladefit
