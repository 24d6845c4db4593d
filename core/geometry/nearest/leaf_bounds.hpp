#pragma once
#include "core/geometry/nearest/minimum_proof.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "core/geometry/surface/foot.hpp"

namespace bladefit {

/// A place of space in the frame of a leaf: axis . (r - c) [mm]. Cost: three dot products.
[[nodiscard]] Vec3 in_frame(const ImageBounds& bounds, const Vec3& r);

/// No point of the leaf is nearer to `w` (in its frame) than this [mm]: the distance to its box.
[[nodiscard]] double least_distance(const ImageBounds& bounds, const Vec3& w);

/// Ranges over the leaf of the derivatives s, t, aa, ab, bb of half the squared distance from `w` (in its frame):
/// 1/2 |w|^2 - w . (S - c) + 1/2 |S - c|^2, the first two times a positive factor. Exact up to the spreads, so tight
/// near the surface. Cost: ten dot products.
[[nodiscard]] DerivativeRanges derivative_ranges(const ImageBounds& bounds, const Vec3& w);

/// The distance from `w` (in its frame) has no stationary point on the leaf: it rises everywhere, or falls, across the
/// sides of constant s or those of constant t. Cost: four dot products.
[[nodiscard]] bool slopes_across(const ImageBounds& bounds, const Vec3& w);

/// The ranges for a side of the leaf along t, where the second derivative counts along t and not along b: tt, scaled,
/// in place of bb.
[[nodiscard]] DerivativeRanges ranges_along_t(const ImageBounds& bounds, const DerivativeRanges& ranges);

/// Parameters of a leaf, 0..1.
struct LocalPlace {
  double s = 0.5, t = 0.5;
};

/// One Newton step of the distance from `w` (in its frame), from the middle of the leaf: a start that evaluates
/// nothing. May lie outside 0..1.
[[nodiscard]] LocalPlace first_guess(const ImageBounds& bounds, const Vec3& w);

}  // namespace bladefit
