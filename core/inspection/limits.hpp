#pragma once
#include <algorithm>

namespace bladefit {

/// What is allowed of a distance on either side of the design [mm]: -minus <= distance <= plus. Infinite: nothing is
/// judged on that side.
class Limits {
 public:
  constexpr Limits(double plus, double minus) : plus_(plus), minus_(minus) {}
  /// The same on both sides.
  [[nodiscard]] static constexpr Limits both(double tolerance) { return {tolerance, tolerance}; }

  [[nodiscard]] constexpr double plus() const { return plus_; }    ///< excess material: beyond it is cut
  [[nodiscard]] constexpr double minus() const { return minus_; }  ///< missing material: beyond it is welded
  /// On the side that a distance lies on.
  [[nodiscard]] constexpr double of(double distance) const { return distance < 0.0 ? minus_ : plus_; }
  /// The nearer to the design of the two.
  [[nodiscard]] constexpr double nearer() const { return std::min(plus_, minus_); }
  [[nodiscard]] constexpr double farther() const { return std::max(plus_, minus_); }

 private:
  double plus_, minus_;
};

}  // namespace bladefit
