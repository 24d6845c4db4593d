#include "firmware_bridge/host/blade/edge_gaps.hpp"

#include <algorithm>

namespace bladefit {
namespace {

constexpr std::size_t kShortGap = 5;  ///< cells: too short to be a word worth

}  // namespace

std::size_t pass_spacing(const std::array<EdgeCell, BladeView::kCells>& edge) {
  std::vector<std::size_t> steps;
  std::size_t before = edge.size();
  for (std::size_t cell = 0; cell < edge.size(); ++cell) {
    if (edge[cell] == EdgeCell::not_probed) continue;
    if (before < edge.size()) steps.push_back(cell - before);
    before = cell;
  }
  if (steps.empty()) return 1;
  std::ranges::sort(steps);
  return steps[(steps.size() - 1) * 4 / 5];
}

std::vector<EdgeGap> edge_gaps(const std::array<EdgeCell, BladeView::kCells>& edge) {
  const std::size_t usual = std::max(2 * pass_spacing(edge), kShortGap);
  std::vector<EdgeGap> gaps;
  for (std::size_t cell = 0; cell < edge.size(); ++cell) {
    const std::size_t first = cell;
    while (cell < edge.size() && edge[cell] == EdgeCell::not_probed) ++cell;
    if (cell - first >= usual) gaps.push_back({first, cell});
  }
  return gaps;
}

}  // namespace bladefit
