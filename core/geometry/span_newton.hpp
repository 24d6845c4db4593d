#pragma once
#include "core/geometry/surface.hpp"

namespace bladefit {

/// The Hessian counts as positive definite where its determinant is above this share of the product of the squared
/// tangents.
inline constexpr double kConvexDeterminant = 1e-9;

/// A foot sought inside one span, in its parameters x = s - 1/2, y = t - 1/2.
struct SpanTask {
  const double* taylor = nullptr;
  std::uint32_t degree_u = 0, degree_v = 0;
  Vec3 r = Vec3::Zero();
  double x_min = -0.5, x_max = 0.5, y_min = -0.5, y_max = 0.5;
  double last_step = 0;  ///< a step [mm] that is not longer is the last: Newton's error is then far under rounding
  double slack = 0;      ///< a squared distance may rise by this share of itself and its square, as rounding [mm]
};

enum class SpanEnd : std::uint8_t {
  converged,  ///< at a local minimum
  left,       ///< the next step leaves the limits
  stuck       ///< the squared distance is not convex here, did not fall, or steps were used up
};

struct SpanFoot {
  double x = 0, y = 0;            ///< where the distance was last seen to fall
  double next_x = 0, next_y = 0;  ///< where the step went that left the limits
  double distance_squared = 0;    ///< at (x, y) [mm^2]; given: not to be exceeded
  bool moved = false;             ///< (x, y) was evaluated: false where even the start was too far off
  SurfacePoint at;                ///< converged: the surface at (x, y), derivatives in x and y
};

/// Pure Newton steps, without the safeguards of project_local(), which takes over where they are needed.
/// Cost: some 65 ns a step for a bicubic span; two steps from a neighbouring foot, at most 12.
[[nodiscard]] SpanEnd newton_in_span(const SpanTask& task, SpanFoot& foot);

}  // namespace bladefit
