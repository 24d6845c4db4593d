#pragma once
#include <Eigen/Geometry>
#include <cmath>

#include "core/inspection/shaft_axis.hpp"
#include "tools/results/blade_drawing.hpp"

namespace bladefit {

/// Cylinder coordinates about the shaft axis, the angle counted from the blade, so that it never jumps on it.
class ShaftFrame {
 public:
  /// `blade` is a place of the blade's middle in the frame of the design [mm].
  ShaftFrame(const ShaftAxis& axis, const Vec3& blade) : axis_(axis) {
    const Vec3 arm = blade - axis.point;
    const Vec3 across = arm - arm.dot(axis.direction) * axis.direction;
    const double length = across.norm();
    up_ = length > 0 ? Vec3(across / length) : Vec3(axis.direction.unitOrthogonal());
    right_ = axis.direction.cross(up_);
  }

  [[nodiscard]] double radius_of(const Vec3& place) const { return axis_.radius_of(place); }
  /// Along the axis from its point [mm].
  [[nodiscard]] double along_of(const Vec3& place) const { return (place - axis_.point).dot(axis_.direction); }
  /// About the axis [rad], -pi to pi.
  [[nodiscard]] double angle_of(const Vec3& place) const {
    const Vec3 arm = place - axis_.point;
    return std::atan2(arm.dot(right_), arm.dot(up_));
  }
  /// On the cylinder of a radius, unrolled.
  [[nodiscard]] UnrolledPlace unrolled(const Vec3& place, double radius) const {
    return {along_of(place), radius * angle_of(place)};
  }
  /// The part of a direction at a place that lies in the cylinder, unrolled; not of unit length.
  [[nodiscard]] UnrolledPlace unrolled_direction(const Vec3& place, const Vec3& direction) const {
    const double angle = angle_of(place);
    const Vec3 around = -std::sin(angle) * up_ + std::cos(angle) * right_;
    return {direction.dot(axis_.direction), direction.dot(around)};
  }

 private:
  ShaftAxis axis_;
  Vec3 up_, right_;
};

}  // namespace bladefit
