#pragma once
#include <cstddef>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// An edge of a surface that runs along another surface's edge.
struct Neighbours {
  std::size_t surface = 0, other = 0;  ///< surface < other
  double gap_mm = 0;                   ///< the largest distance on the way
};

/// The pairs of surfaces that have edges side by side, no farther apart than `reach_mm`. Cost: some microseconds a pair
/// of surfaces whose boxes meet.
[[nodiscard]] std::vector<Neighbours> find_neighbours(const std::vector<NurbsSurface>& surfaces, double reach_mm);

/// Gaps: of the pairs above those more than `closed_mm` apart, by edges beside which no other face is within that.
/// Where a narrow face lies between two others there is none. Cost: as above.
[[nodiscard]] std::vector<Neighbours> find_gaps(const std::vector<NurbsSurface>& surfaces, double closed_mm,
                                                double reach_mm);

}  // namespace bladefit
