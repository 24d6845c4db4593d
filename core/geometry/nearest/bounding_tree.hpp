#pragma once
#include "core/geometry/surface/design_image.hpp"
#include "core/geometry/surface/foot.hpp"

namespace bladefit {

/// Lower bounds of the distances from a point to the boxes of the image's tree, four at a time in single precision.
class BoxDistances {
 public:
  /// `arm`: from the middle of the design to the point [mm].
  explicit BoxDistances(const Vec3& arm);

  /// A square from here on means: not nearer than `limit` [mm].
  [[nodiscard]] float threshold(double limit) const;

  using Four = Eigen::Array<float, 4, 1, Eigen::DontAlign>;
  /// Squares of the distances to the boxes of a node's children [mm^2], to within the rounding that threshold() allows
  /// for; infinite where there is no child.
  [[nodiscard, gnu::always_inline]] Four squares(const ImageNode& node) const {
    Four sum = Four::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Map<const Four> low(node.low[axis]), high(node.high[axis]);
      const Four beyond = (low - arm_[axis]).max(arm_[axis] - high).max(0.0F);
      sum += beyond * beyond;
    }
    return sum;
  }

 private:
  Eigen::Array<float, 3, 1> arm_;  ///< the point about the middle of the design
  double rounding_;                ///< of the distances [mm]
};

}  // namespace bladefit
