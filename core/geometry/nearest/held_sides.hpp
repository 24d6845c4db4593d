#pragma once
#include "core/geometry/nearest/local_projection.hpp"

namespace bladefit {

/// The sides of its span that a projection is held at, and what lies beyond them.
struct HeldSides {
  int count = 0;  ///< 0..2; a side beyond which the surface goes on smoothly is none
  FootBorder border = FootBorder::none;
  double side = 1.0;     ///< +1: the point is outside of the material, -1: inside, which only joints can tell
  double outward = 0.0;  ///< share of the offset's length that leads beyond the outer edge, along the surface: 0..1
};

/// A projection that is held at a smooth joint but leans far across it is no foot of the whole surface, only of its
/// patch: that side counts. Cost: some ten dot products; nothing where the projection is not held.
[[nodiscard]] HeldSides held_sides(const Surface& surface, const Projection& projection);

/// It is held at an edge beyond which another patch continues the surface smoothly: the foot may lie there.
[[nodiscard]] bool falls_over_seam(const Surface& surface, const Projection& projection);

}  // namespace bladefit
