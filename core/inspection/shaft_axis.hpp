#pragma once
#include "core/algebra/matrix.hpp"

namespace bladefit {

/// The axis of the shaft in the frame of the design, from which the radii of places are measured [mm].
struct ShaftAxis {
  Vec3 point = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();  ///< of length 1

  /// Distance of a place from the axis [mm].
  [[nodiscard]] double radius_of(const Vec3& place) const {
    const Vec3 arm = place - point;
    return (arm - arm.dot(direction) * direction).norm();
  }
};

}  // namespace bladefit
