#pragma once
#include "core/geometry/nearest/local_projection.hpp"

namespace bladefit {

/// What the image knows of a foot without a search.
struct ReachProof {
  bool nearest = false;  ///< it is the nearest point of the whole design
  double margin = 0;     ///< every other local minimum is farther by no less than this [mm]
};

/// Whether a converged projection that no side holds, `offset` = r - q and `cross` = Su x Sv there, is the nearest
/// point of the design, by the reach of its span on the side of the point (ImageSpan::reach): nearer than that, the
/// ball about the point through the foot lies in one that is empty. Feet within a millionth of a span from its sides
/// are not told of: they might lie in the next one. Cost: some twenty operations.
[[nodiscard]] bool nearest_by_reach(const Surface& surface, const SurfacePlace& foot, const Vec3& offset,
                                    const Vec3& cross);

/// The same with the margin. With d the distance, R the reach and s another local minimum, which is no nearer to the
/// foot f than `apart`: |s - r|^2 = |s - f|^2 - 2 d (s - f).n + d^2, and 2 R (s - f).n <= |s - f|^2, so
/// |s - r|^2 >= apart^2 (1 - d / R) + d^2.
[[nodiscard]] ReachProof proof_by_reach(const Surface& surface, const Projection& foot);

}  // namespace bladefit
