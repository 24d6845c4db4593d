#pragma once
#include "core/fit/pose.hpp"

namespace bladefit {

/// Parameters of a motion near a reference pose: x = (L w, s) [mm], r' = pivot + exp([w]x)(r - pivot) + s.
/// The pivot is the middle of the design and L its half diagonal, so that all six are lengths of one size.
struct MotionFrame {
  Vec3 pivot = Vec3::Zero();
  double length = 1.0;  ///< L [mm]
};

[[nodiscard]] Pose moved(const Pose& pose, const Vec6& x, const MotionFrame& frame);
[[nodiscard]] Vec6 motion_between(const Pose& from, const Pose& to, const MotionFrame& frame);

}  // namespace bladefit
