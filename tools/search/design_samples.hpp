#pragma once
#include <cstdint>
#include <vector>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// A place of the design, as the coarse search knows it. Lengths in mm.
struct DesignSample {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< outward
  std::uint32_t patch = 0;
};

/// Samples of a design, spread evenly along both directions of each patch.
struct DesignSamples {
  std::vector<DesignSample> samples;
  double spacing_mm = 0;        ///< between neighbours, about
  Vec3 centre = Vec3::Zero();   ///< mean of the samples
  double extent_mm = 0;         ///< largest distance of two samples, about (never more)
  double half_diagonal_mm = 0;  ///< of the design: the scale of all lengths here
};

/// About `count` samples, `offset_mm` outside the surface (the radius of a probe ball). Cost: some evaluations a
/// sample.
[[nodiscard]] DesignSamples sample_design(const Surface& surface, std::size_t count, double offset_mm);

/// Largest distance of two of the points, about: never more, and at least half of it. Cost: linear.
[[nodiscard]] double extent_of(const std::vector<Vec3>& points);

}  // namespace bladefit
