#pragma once
#include <vector>

namespace bladefit {

/// A cubic spline through values at rising places, with no knot at the second and the last but one (not-a-knot end
/// conditions); of fewer than four values the polynomial through them. Beyond the ends its polynomial goes on.
class NotAKnotSpline {
 public:
  /// At least two places, strictly rising, and a value at each. Cost: places^3, once.
  NotAKnotSpline(std::vector<double> places, std::vector<double> values);

  [[nodiscard]] double at(double place) const;

 private:
  std::vector<double> places_, values_, second_;  ///< second derivatives at the places
};

}  // namespace bladefit
