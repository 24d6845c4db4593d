#pragma once
#include "core/geometry/nearest/local_projection.hpp"

namespace bladefit {

/// A point to be projected onto the whole design.
struct ProjectionQuery {
  Vec3 point = Vec3::Zero();     ///< r, in design coordinates [mm]
  Vec3 approach = Vec3::Zero();  ///< unit vector from the probe to the material, in design coordinates; 0 = unknown
  double margin = 0;             ///< other local minima are looked for up to this much farther than the nearest [mm]
};

/// The next-nearest local minimum, and how much farther it is than the nearest. Minima that do not face the probe, but
/// almost do, count too.
struct RunnerUp {
  /// No other local minimum is within this much beyond the nearest; at most query.margin [mm]. While the point moves by
  /// less than half of it, the local minimum it is tracked to stays the nearest.
  double margin = 0;
  /// Apart from the runner-up none is within this much, so one of the two stays the nearest while the point moves by
  /// less than half of it; at most a quarter of query.margin [mm].
  double margin_to_third = 0;
  SurfacePlace place;  ///< of the runner-up, where margin < margin_to_third
};

/// What a search with this margin [mm] says where it meets no other local minimum within it.
[[nodiscard]] RunnerUp nothing_within(double margin);

struct GlobalProjection {
  Projection nearest;
  bool proven = false;  ///< false: the cap on pieces was reached; `nearest` is the best found
  bool faces = true;    ///< false: no local minimum faces the probe, so `nearest` is the nearest of all
  RunnerUp runner_up;
  std::uint32_t pieces = 0;  ///< pieces of leaves that were looked at, where their bounds did not suffice
  bool exhausted = false;    ///< a cap was reached
};

/// Pieces that one search may look at. Typical is none; a point on the medial axis of a rounding needs the most.
inline constexpr std::uint32_t kMaxPieces = 8192;

/// The nearest point of the whole design, by branch and bound over the bounding tree and the bounds of its leaves and,
/// where these do not suffice, over rectangles inside the leaves whose distance is bounded by Bernstein coefficients.
/// With an approach vector: the nearest local minimum whose outward normal faces the probe, n . approach < 0 (thesis 4;
/// 2 % thick blades need it); where there is none, the nearest point of all. `hint` (may be null) is a projection to
/// start from; the answer does not depend on it beyond rounding. Proven to within 1e-10 of the half diagonal of the
/// design.
[[nodiscard]] GlobalProjection project_global(const Surface& surface, const ProjectionQuery& query,
                                              const Projection* hint);

/// True where an outward normal of any length faces the probe, or the approach is unknown.
[[nodiscard]] inline bool faces_probe(const Vec3& outward, const Vec3& approach) {
  return approach.squaredNorm() < 0.5 || outward.dot(approach) < 0.0;
}
/// The same of a projection.
[[nodiscard]] bool faces_probe(const Surface& surface, const Projection& projection, const Vec3& approach);

}  // namespace bladefit
