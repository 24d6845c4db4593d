#include "tools/design/nurbs/trim_loops.hpp"

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

}  // namespace bladefit
