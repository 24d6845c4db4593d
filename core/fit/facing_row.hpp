#pragma once
#include "core/fit/motion_frame.hpp"
#include "core/geometry/nearest/local_projection.hpp"

namespace bladefit {

/// How a foot faces its probe, to first order in the motion parameters x: n . a, below 0 where it does.
struct FacingRow {
  double facing = 0;
  Vec6 gradient = Vec6::Zero();  ///< [1/mm]
};

/// Of a foot inside a smooth piece of the surface at the pose x = 0. `normal`: its outward unit normal; `r`: the point;
/// `approach`: unit vector from the probe to the material, which turns with the pose. The normal turns by Weingarten's
/// equations. Cost: some 60 multiplications.
[[nodiscard]] FacingRow facing_row(const Projection& projection, const Vec3& normal, const Vec3& r,
                                   const Vec3& approach, const MotionFrame& frame);

}  // namespace bladefit
