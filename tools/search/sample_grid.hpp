#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "tools/search/design_samples.hpp"

namespace bladefit {

/// The sample near to any place, looked up in a grid of cells. Coarse: it is the nearest to the middle of the cell, and
/// beyond the grid that of the cell nearest to the place.
class SampleGrid {
 public:
  /// Keeps a reference to `samples`. Cost: some 20 ms.
  explicit SampleGrid(const DesignSamples& samples);

  /// Cost: one look-up.
  [[nodiscard]] const DesignSample& near(const Vec3& point) const {
    std::size_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = (point[axis] - low_[axis]) * per_mm_;
      const auto last = static_cast<double>(size_[static_cast<std::size_t>(axis)] - 1);
      const double inside = step < 0.0 ? 0.0 : step < last ? step : last;
      cell = cell * size_[static_cast<std::size_t>(axis)] + static_cast<std::size_t>(inside);
    }
    return samples_.samples[nearest_[cell]];
  }

 private:
  using Cell = std::array<std::int32_t, 3>;

  [[nodiscard]] std::size_t index_of(const Cell& cell) const;
  [[nodiscard]] Vec3 middle_of(const Cell& cell) const;
  void offer(const Cell& cell, std::uint32_t sample);
  void seed();
  void pass(bool forward);

  const DesignSamples& samples_;
  Vec3 low_ = Vec3::Zero();
  double per_mm_ = 1;
  std::array<std::size_t, 3> size_{};
  std::vector<std::uint32_t> nearest_;
  std::vector<float> square_;  ///< of the distance of nearest_ from the middle of the cell, while the grid is filled
};

}  // namespace bladefit
