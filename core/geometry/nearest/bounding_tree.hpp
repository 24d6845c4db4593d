#pragma once
#include <cstring>

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

  /// Of GCC and Clang, who take wide registers for it where there are some.
  using Four = float __attribute__((vector_size(16)));
  /// Squares of the distances to the boxes of a node's children [mm^2], to within the rounding that threshold() allows
  /// for; infinite where there is no child.
  [[nodiscard, gnu::always_inline]] Four squares(const ImageNode& node) const {
    Four sum{};
    for (int axis = 0; axis < 3; ++axis) {
      Four low, high;
      std::memcpy(&low, node.low[axis], sizeof low);
      std::memcpy(&high, node.high[axis], sizeof high);
      const Four below = low - arm_[axis], above = arm_[axis] - high, farther = below > above ? below : above;
      const Four beyond = farther > 0.0F ? farther : Four{};
      sum += beyond * beyond;
    }
    return sum;
  }

 private:
  Eigen::Array<float, 3, 1> arm_;  ///< the point about the middle of the design
  double rounding_;                ///< of the distances [mm]
};

}  // namespace bladefit
