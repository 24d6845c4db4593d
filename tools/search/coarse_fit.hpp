#pragma once
#include <span>
#include <vector>

#include "core/fit/pose.hpp"
#include "tools/search/sample_grid.hpp"

namespace bladefit {

/// How a coarse fit goes.
struct CoarsePlan {
  int steps = 8;
  double reach_mm = 0;      ///< points farther from the samples than this pull less and less
  double tangential = 0.1;  ///< weight of the squared distance along the surface, beside 1 of that along the normal
};

/// Moves `pose` towards the samples by steps of Gauss and Newton, each to the samples that are near at the time (point
/// to plane, with a share of point to point, which keeps points from sliding off an edge). Cost: some 50 ns a point and
/// step.
void fit_coarsely(const SampleGrid& grid, std::span<const Vec3> points, const CoarsePlan& plan, Pose& pose);

/// Mean of the squared distances from the samples, none of them counted above `reach_mm`, and the parts along the
/// surface only beyond `spacing_mm` [mm^2].
[[nodiscard]] double coarse_misfit(const SampleGrid& grid, std::span<const Vec3> points, const Pose& pose,
                                   double reach_mm, double spacing_mm);

}  // namespace bladefit
