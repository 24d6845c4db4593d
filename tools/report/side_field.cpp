#include "tools/report/side_field.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

int cell_at(double share) { return std::clamp(static_cast<int>(share * SideField::kCells), 0, SideField::kCells - 1); }

std::size_t cell_index(int radius_cell, int chord_cell) {
  return static_cast<std::size_t>(radius_cell * SideField::kCells + chord_cell);
}

}  // namespace

SideField::SideField(const Result& result, const ToleranceScale& scale, BladeSide side)
    : cells_(static_cast<std::size_t>(kCells * kCells)) {
  const BladeDrawing& drawing = *result.drawing;
  const double range = drawing.tip_radius - drawing.root_radius;
  std::size_t index = 0;
  for (const ResultPoint& point : result.points) {
    const PlacedPoint& place = drawing.points[index++];
    if (place.face != side || point.state == PointState::rejected || std::isnan(place.chord) || !(range > 0)) continue;
    Cell& cell = cells_[cell_index(cell_at((place.radius - drawing.root_radius) / range), cell_at(place.chord))];
    cell.sum += scale.share(point);
    cell.count += 1;
  }
}

std::optional<double> SideField::share(int radius_cell, int chord_cell) const {
  double sum = 0, weights = 0;
  for (int i = std::max(0, radius_cell - kReach); i <= std::min(kCells - 1, radius_cell + kReach); ++i) {
    for (int j = std::max(0, chord_cell - kReach); j <= std::min(kCells - 1, chord_cell + kReach); ++j) {
      const Cell& cell = cells_[cell_index(i, j)];
      if (cell.count == 0) continue;
      const double apart = (i - radius_cell) * (i - radius_cell) + (j - chord_cell) * (j - chord_cell);
      const double weight = 1.0 / (0.1 + apart);
      sum += weight * cell.sum / cell.count;
      weights += weight;
    }
  }
  return weights > 0 ? std::optional(sum / weights) : std::nullopt;
}

}  // namespace bladefit
