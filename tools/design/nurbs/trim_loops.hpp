#pragma once
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// Calls `use` with both ends of every straight piece of the loops.
template <class Use>
void each_piece(const std::vector<TrimLoop>& loops, Use use) {
  for (const TrimLoop& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) use(loop[k], loop[(k + 1) % loop.size()]);
  }
}

/// A place is inside of the loops: a line from it crosses them an odd number of times; true where there are none.
/// Cost: linear in the number of pieces.
[[nodiscard]] bool inside_loops(const std::vector<TrimLoop>& loops, double u, double v);

/// Where the line of constant `v` crosses the loops, rising: inside of them from the first to the second, and so on.
[[nodiscard]] std::vector<double> crossings_at(const std::vector<TrimLoop>& loops, double v);

}  // namespace bladefit
