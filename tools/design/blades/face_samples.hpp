#pragma once
#include <Eigen/Core>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// A place of a face.
struct FaceSample {
  Eigen::Vector3d point;   ///< [mm]
  Eigen::Vector3d normal;  ///< along Su x Sv, of length 1
  double area = 0;         ///< that it stands for [mm^2]
};

/// Places inside of the trim loops of each surface, on a grid of 8 x 8 to 24 x 24, fewer where there are many surfaces.
/// A surface whose loops leave none of them has all. Cost: some microseconds a place.
[[nodiscard]] std::vector<std::vector<FaceSample>> sample_faces(const std::vector<NurbsSurface>& surfaces);

}  // namespace bladefit
