#pragma once
#include <vector>

namespace bladefit {

/// The radii at which points were measured: the middles of the clusters that the radii of the points make, where there
/// are at most kMostSections and nearly all points are in one of three points or more; else the radii that naval forms
/// have (0.2, 0.25, 0.3, 0.4 ... 0.9, 0.95, 0.975 of R) within those of the points. Rising. Cost: n log n.
[[nodiscard]] std::vector<double> measured_radii(std::vector<double> radii, double tip_radius);
inline constexpr std::size_t kMostSections = 24;

}  // namespace bladefit
