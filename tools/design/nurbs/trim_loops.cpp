#include "tools/design/nurbs/trim_loops.hpp"

#include <algorithm>

namespace bladefit {

bool inside_loops(const std::vector<TrimLoop>& loops, double u, double v) {
  bool inside = loops.empty();
  each_piece(loops, [&](const TrimVertex& a, const TrimVertex& b) {
    if ((a.v > v) == (b.v > v)) return;
    const double turn = (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
    if ((turn < 0.0) == (b.v > a.v)) inside = !inside;
  });
  return inside;
}

std::vector<double> crossings_at(const std::vector<TrimLoop>& loops, double v) {
  std::vector<double> crossings;
  each_piece(loops, [&](const TrimVertex& a, const TrimVertex& b) {
    if ((a.v > v) != (b.v > v)) crossings.push_back(a.u + (b.u - a.u) * (v - a.v) / (b.v - a.v));
  });
  std::ranges::sort(crossings);
  return crossings;
}

}  // namespace bladefit
