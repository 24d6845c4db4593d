#pragma once
#include "core/geometry/bezier.hpp"
#include "core/geometry/foot.hpp"

namespace bladefit {

/// What the control net of a piece of surface proves about its distance from a point.
struct DistanceCertificate {
  bool farther = false;  ///< no point of the piece is nearer than the bound
  bool convex = false;   ///< g = w^2 (distance^2 - bound^2) is strictly convex over the piece's parameters
};

/// Cheap test: is the whole net beyond the plane at `bound` [mm] across the direction from r to its middle?
[[nodiscard]] bool beyond_plane(const BezierNet& net, const Vec3& r, double bound);

/// Tests the Bernstein coefficients of g(u, v) = |A - w r|^2 - (bound w)^2, a polynomial of twice the degree: none
/// below -tolerance: nothing is nearer than the bound; second differences definite: g is convex, so a point that
/// satisfies the first-order conditions on the piece is its only minimum there.
/// `tolerance` [mm^2]. Cost: (order_u order_v)^2 / 2 four-vector products, about 140 for a bicubic net.
[[nodiscard]] DistanceCertificate certify_distance(const BezierNet& net, const Vec3& r, double bound, double tolerance);

}  // namespace bladefit
