#include "tools/search/sample_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bladefit {
namespace {

/// Cells of the grid, about.
constexpr double kCells = 160000;
/// How far the grid reaches beyond the samples [half diagonals].
constexpr double kMargin = 0.2;

}  // namespace

SampleGrid::SampleGrid(const DesignSamples& samples) : samples_(samples) {
  Vec3 high = samples.samples.front().point;
  low_ = high;
  for (const DesignSample& sample : samples.samples) {
    low_ = low_.cwiseMin(sample.point);
    high = high.cwiseMax(sample.point);
  }
  const Vec3 margin = Vec3::Constant(kMargin * samples.half_diagonal_mm);
  low_ -= margin;
  const Vec3 box = high + margin - low_;
  per_mm_ = std::cbrt(kCells / box.prod());
  std::size_t cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = static_cast<std::size_t>(box[axis] * per_mm_) + 1;
    size_[static_cast<std::size_t>(axis)] = count;
    cells *= count;
  }
  nearest_.assign(cells, 0);
  square_.assign(cells, std::numeric_limits<float>::infinity());
  seed();
  pass(true);
  pass(false);
  square_ = {};
}

std::size_t SampleGrid::index_of(const Cell& cell) const {
  std::size_t index = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) index = index * size_[axis] + static_cast<std::size_t>(cell[axis]);
  return index;
}

Vec3 SampleGrid::middle_of(const Cell& cell) const {
  return low_ + (Vec3(cell[0], cell[1], cell[2]) + Vec3::Constant(0.5)) / per_mm_;
}

void SampleGrid::offer(const Cell& cell, std::uint32_t sample) {
  const std::size_t index = index_of(cell);
  const auto square = static_cast<float>((samples_.samples[sample].point - middle_of(cell)).squaredNorm());
  if (!(square < square_[index])) return;
  square_[index] = square;
  nearest_[index] = sample;
}

/// Each sample to its own cell.
void SampleGrid::seed() {
  for (std::uint32_t k = 0; k < samples_.samples.size(); ++k) {
    const Vec3 steps = (samples_.samples[k].point - low_) * per_mm_;
    Cell cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell.at(static_cast<std::size_t>(axis)) = static_cast<std::int32_t>(steps[axis]);
    offer(cell, k);
  }
}

/// One pass over all cells, each of which takes the samples of the neighbours that were visited before it. After one in
/// either direction each cell has the nearest sample, or one that is hardly farther.
void SampleGrid::pass(bool forward) {
  const std::array<std::int32_t, 3> size{static_cast<std::int32_t>(size_[0]), static_cast<std::int32_t>(size_[1]),
                                         static_cast<std::int32_t>(size_[2])};
  const auto count = static_cast<std::int64_t>(nearest_.size());
  for (std::int64_t step = 0; step < count; ++step) {
    const auto index = static_cast<std::int32_t>(forward ? step : count - 1 - step);
    const Cell cell{index / (size[1] * size[2]), index / size[2] % size[1], index % size[2]};
    for (int neighbour = 0; neighbour < 13; ++neighbour) {  // the first 13 of 27 come before the cell itself
      Cell from{neighbour / 9 - 1, neighbour / 3 % 3 - 1, neighbour % 3 - 1};
      bool inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        from[axis] = cell[axis] + (forward ? from[axis] : -from[axis]);
        inside = inside && from[axis] >= 0 && from[axis] < size[axis];
      }
      if (!inside) continue;
      const std::size_t source = index_of(from);
      if (std::isfinite(square_[source])) offer(cell, nearest_[source]);
    }
  }
}

}  // namespace bladefit
