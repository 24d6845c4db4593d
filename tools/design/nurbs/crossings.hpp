#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// Where two surfaces pass through each other, or one through itself.
struct Crossing {
  std::size_t surface = 0, other = 0;  ///< surface <= other
  double extent_mm = 0;                ///< diagonal of the box around the places where they do
  Eigen::Vector3d place;               ///< one of these [mm]
};

/// The surfaces that reach more than `depth_mm` beyond each other within their trims, the widest first. Looked for on
/// facets: what is less deep than four times their distance from the surfaces, or narrower than they are, may be
/// missed; edges that touch are none. Cost: tens of milliseconds for a blade.
[[nodiscard]] std::vector<Crossing> find_crossings(const std::vector<NurbsSurface>& surfaces, double depth_mm);

}  // namespace bladefit
