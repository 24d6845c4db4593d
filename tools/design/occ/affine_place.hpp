#pragma once
#include <gp_Trsf.hxx>

#include <Eigen/Geometry>

namespace bladefit {

/// A place of OpenCASCADE, turned, mirrored and scaled as it may be.
[[nodiscard]] inline Eigen::Affine3d affine_of(const gp_Trsf& place) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) result(row, column) = place.Value(row + 1, column + 1);
  }
  return result;
}

}  // namespace bladefit
