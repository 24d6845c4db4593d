#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/surface/surface.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// Which side of a design is away from the material, and why.
struct OutwardSide {
  int sign;            ///< +1: that of Su x Sv (of reversed surfaces the other); -1: the opposite
  std::string reason;  ///< one line
};

/// What the winding number tells of surfaces that close around the material, with gaps such as an open trailing edge,
/// root and tip: seen from the surfaces' own points it is then near +1/2 or -1/2, but near 0 on an open sheet. Each
/// surface is taken with the side that it has (`reversed`).
struct SideVote {
  std::optional<OutwardSide> side;  ///< nothing where the shape does not tell
  bool contradiction = false;       ///< some surfaces say the one, others the other
};
[[nodiscard]] SideVote vote_by_winding(const std::vector<NurbsSurface>& surfaces);

/// The same of a compiled design, more coarsely; nothing where the shape does not tell. Cost: some 10 ms.
[[nodiscard]] std::optional<OutwardSide> outward_side_of(const Surface& surface);

}  // namespace bladefit
