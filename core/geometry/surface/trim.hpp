#pragma once
#include <algorithm>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// A piece of a trim loop: straight in the parameters of its patch, at t = 0..1.
struct TrimLine {
  std::uint32_t span = 0;
  double u = 0, v = 0;    ///< at t = 0
  double du = 0, dv = 0;  ///< to t = 1

  [[nodiscard]] SurfacePlace at(double t) const { return {span, u + t * du, v + t * dv}; }
};

[[nodiscard]] inline TrimLine line_of(const DesignImage& image, std::uint32_t trim) {
  const ImageTrim& from = image.trims()[trim];
  const ImageTrim& to = image.trims()[from.next];
  return {from.span, from.u, from.v, to.u - from.u, to.v - from.v};
}

/// Along a direction of the parameters: the tangent of the surface, and the second derivative [mm].
[[nodiscard]] inline Vec3 tangent_along(const SurfacePoint& at, double du, double dv) {
  return du * at.s_u + dv * at.s_v;
}
[[nodiscard]] inline Vec3 second_along(const SurfacePoint& at, double du, double dv) {
  return du * du * at.s_uu + 2.0 * du * dv * at.s_uv + dv * dv * at.s_vv;
}

/// Across a piece of a loop that runs along (du, dv), out of the face: unit vector square to the piece; zero where the
/// parametrisation is degenerate.
[[nodiscard]] Vec3 out_of_face(const SurfacePoint& at, double du, double dv);

/// The slab of a patch that a parameter lies in, of `count` of them.
[[nodiscard]] inline std::uint32_t slab_of(double v, std::uint32_t count) {
  const double place = std::clamp(v, 0.0, 1.0) * count;
  return std::min(static_cast<std::uint32_t>(place), count - 1);
}

/// The place is in its face: its patch has no trim loops, or a line from it crosses them an odd number of times.
/// Cost: a comparison for each piece in the slab, some ten.
[[nodiscard]] bool inside_face(const DesignImage& image, const SurfacePlace& place);

}  // namespace bladefit
