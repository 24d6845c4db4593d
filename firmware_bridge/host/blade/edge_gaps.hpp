#pragma once
#include <vector>

#include "firmware_bridge/host/blade/blade_view.hpp"

namespace bladefit {

/// Cells of the leading edge from `first` to before `end`.
struct EdgeGap {
  std::size_t first = 0, end = 0;
  [[nodiscard]] std::size_t length() const { return end - first; }
};

/// How many cells the passes of a program are usually apart: four of five lie no farther from the one before; 1 where
/// there are no two.
[[nodiscard]] std::size_t pass_spacing(const std::array<EdgeCell, BladeView::kCells>& edge);

/// The stretches without a point, those left out that lie between passes: up to twice the usual spacing.
[[nodiscard]] std::vector<EdgeGap> edge_gaps(const std::array<EdgeCell, BladeView::kCells>& edge);

}  // namespace bladefit
