#pragma once
#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// Limits of the patch parameters in which a local minimum is sought.
struct ParameterLimits {
  double u_min = 0, u_max = 1, v_min = 0, v_max = 1;
};

/// The piece of a trim loop that a projection is held at.
struct TrimHold {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::uint32_t trim = kNone;
  bool at_corner = false;  ///< at its start, which is a corner of the loop
  double du = 0, dv = 0;   ///< the way of the piece in the patch's parameters
};

/// A local minimum of the distance from a point to the design.
struct Projection {
  SurfacePlace place;
  SurfacePoint at;                        ///< the surface there
  Vec3 offset = Vec3::Zero();             ///< r - q [mm]
  bool fixed_u = false, fixed_v = false;  ///< held at a limit, the distance falling beyond it
  bool converged = false;                 ///< false: the iteration cap was reached or the point is a saddle
  bool at_pole = false;                   ///< on a side that is one point: it looked along the ways of its patch alone
  bool outside = false;                   ///< of the trim loops of its patch: no foot, the face is not there
  TrimHold trim;
  [[nodiscard]] bool on_trim() const { return trim.trim != TrimHold::kNone; }
  [[nodiscard]] double distance_squared() const { return offset.squaredNorm(); }
};

/// Newton's method for the foot of `r` (thesis 4, Appendix C), stepping across spans, clamped to `limits`; a step that
/// would not lower the distance is halved. Start anywhere inside the limits of the patch of `start`.
/// Converges quadratically: two or three evaluations from a neighbouring foot; at most 60. Trim loops do not hold it:
/// where it ends beyond them it is `outside`.
[[nodiscard]] Projection project_local(const Surface& surface, const Vec3& r, const SurfacePlace& start,
                                       const ParameterLimits& limits = {});

/// The foot that a projection stands for. `probe_radius` [mm] is subtracted from the distance. A foot that is held at a
/// smooth joint is interior: the neighbour continues the surface there, but for a gap or a bend within the design's
/// accuracy, and its distance is along the normal. At a joint that bends, it is an edge, and its distance is the length
/// of r - q, negative where r is inside of the material.
[[nodiscard]] Foot foot_of(const Surface& surface, const Projection& projection, double probe_radius);

}  // namespace bladefit
