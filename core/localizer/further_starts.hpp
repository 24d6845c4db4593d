#pragma once
#include "core/fit/pose.hpp"

namespace bladefit {

/// A search for a better optimum of a mode beside least squares, which has several: the mode's programs start again
/// from poses about the least-squares optimum, over every `stride`-th point. The search changes neither the pose nor
/// any stored point; what it finds is made exact over all points.
struct FurtherStarts {
  bool active = false, done = false, gone_back = false;
  Pose centre;                ///< the least-squares optimum
  Mat6 steps = Mat6::Zero();  ///< columns: from there to a start; as many lie opposite
  std::uint32_t stride = 1;
  std::uint32_t start = 0;   ///< under way; 0: from the optimum that the mode has found, for comparison
  std::uint32_t sweeps = 0;  ///< of this start
  Pose pose, last_pose;      ///< of this start, and before its last step
  double found = 0;          ///< value of the optimum that the mode has found, over the points looked at
  double best = 0;           ///< least value of all
  Pose best_pose;
  std::uint32_t same = 0;         ///< starts that came to the best optimum
  std::uint32_t same_as_own = 0;  ///< starts that came to the one that the mode has found
  Pose own_pose;                  ///< that optimum, to go back to
  double own_value = 0;           ///< its value over all points; infinite where there is none
};

}  // namespace bladefit
