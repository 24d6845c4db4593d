#pragma once
#include <array>
#include <vector>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// An upper bound of the reach by samples: what there is no use in proving more than.
class ReachGuess {
 public:
  /// Samples every leaf at nine places.
  explicit ReachGuess(const Surface& surface);

  /// The greatest reach that is told of [mm]: what lies farther off than this is searched.
  [[nodiscard]] double most() const { return most_; }

  /// The radius of the ball that touches at a foot with unit `normal`, to the side that this points to, shrunk until no
  /// sample is in it; at most `most`. Cost: a microsecond or two.
  [[nodiscard]] double radius_at(const Vec3& foot, const Vec3& normal, double most) const;

 private:
  const Surface& surface_;
  double most_;
  std::vector<std::array<Vec3, 9>> samples_;
};

}  // namespace bladefit
