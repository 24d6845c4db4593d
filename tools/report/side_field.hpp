#pragma once
#include <optional>
#include <vector>

#include "tools/report/tolerance_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// Distances in tolerances between the points of one side: means of cells over radius and chord, each spread to its
/// neighbours by the inverse square of how many cells they are apart.
class SideField {
 public:
  static constexpr int kCells = 30;  ///< from root to tip, and from leading to trailing edge
  static constexpr int kReach = 2;   ///< cells to which a mean is spread

  SideField(const Result& result, const ToleranceScale& scale, BladeSide side);

  /// Of a cell; nothing where no point lies within kReach cells.
  [[nodiscard]] std::optional<double> share(int radius_cell, int chord_cell) const;

 private:
  struct Cell {
    double sum = 0, count = 0;
  };
  std::vector<Cell> cells_;
};

}  // namespace bladefit
