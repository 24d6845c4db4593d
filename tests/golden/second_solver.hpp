#pragma once
#include "tests/support/mode_value.hpp"

namespace bladefit::testing {

struct SecondOptimum {
  double value = 0;  ///< of the mode's objective [mm; mm^2 in constrained]
  Pose pose;
};

/// The optimum of a mode by SLSQP of NLopt, from a start pose: max |d| / w, or max d - min d, as the smallest variable
/// that bounds the distances of all points, or the sum of squares within the bounds. `weights`: w of each point. It
/// shares the nearest points with the localizer and nothing else: derivatives are differences of distances. Cost:
/// seconds.
[[nodiscard]] SecondOptimum solve_again(const ModeValue& objective, const std::vector<double>& weights,
                                        const Pose& start);

}  // namespace bladefit::testing
