#pragma once
#include <optional>

#include "tools/design/image/smooth_sides.hpp"
#include "tools/design/image/surface_part.hpp"

namespace bladefit {

/// A side of the surface: 0 that of Su x Sv, 1 the other one.
using SurfaceSide = std::size_t;
[[nodiscard]] constexpr double sign_of(SurfaceSide side) { return side == 0 ? 1.0 : -1.0; }

/// Where points s lie from feet f: s - f in the frame of the feet [mm]. With n the unit normal at f, a ball of radius R
/// that touches in f does not hold s where |s - f|^2 >= 2 R (s - f).n. With the normal along m = (1, slope), which is
/// no shorter than n, (s - f).m in place of (s - f).n is on the safe side, and the sum of what either is in each axis
/// has its least where that of each axis has.
struct FarBox {
  IntervalVector arm;

  [[nodiscard]] bool clear(const PartView& feet, SurfaceSide side, double radius) const;
  [[nodiscard]] double distance() const;
};

/// The same for points of one smooth piece with the feet, over a rectangle H of the patch that holds both. From f to s
/// straight in the parameters, by x in Sa, Sb: s - f = J x and 2 (s - f).n = x.K x, where J = [Sa Sb] and K, made of
/// the second derivatives times n, are means over that way, since the first term of 2 (s - f).n vanishes. So the ball
/// is empty where J'J - R K is positive definite, whatever J and K are within their ranges over H. The slope of 1/2 |S
/// - r|^2 at s on that way, with r = f + d n, is x.(J'J - d K) x with other means, so that where this holds for R it
/// rises from f on for every d < R: there is no other local minimum in H.
struct NearForm {
  PatchRect rect;
  Interval m_aa, m_ab, m_bb;  ///< of J'J, the two factors taken apart
  Interval k_aa, k_ab, k_bb;  ///< second derivatives times (1, slope) [1/mm]

  [[nodiscard]] bool clear(SurfaceSide side, double radius) const;
};

/// Nothing where a side within `rect` is not smooth, or where there are too many spans in it.
/// Cost: some microseconds a span.
[[nodiscard]] std::optional<NearForm> near_form(const Surface& surface, const SmoothSides& smooth, const PartView& feet,
                                                const PatchRect& rect);

}  // namespace bladefit
