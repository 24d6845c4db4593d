#pragma once
#include <cstdint>
#include <limits>

#include "core/fit/pose.hpp"
#include "core/localizer/further_starts.hpp"

namespace bladefit {

/// Where a fit over all stored points stands.
struct Refinement {
  bool active = false;
  bool thorough = false;  ///< every foot of this sweep is to be proven
  bool bounded = false;   ///< beyond least squares: the mode's programs move the pose
  std::uint32_t sweeps = 0, changed = 0, unproven = 0;
  std::uint32_t rounds = 0;  ///< in which regions followed the feet, or the scale of the loss the distances
  double last_value = 0;     ///< sum 1/2 d^2 of the sweep before
  std::uint32_t last_count = 0;
  Pose last_pose;
  Vec6 last_step = Vec6::Zero();
  Pose rows_pose;        ///< of the sweep before
  double travelled = 0;  ///< from there to that of this sweep [mm]
  /// The pose has travelled so far since the last sweep that searched every foot and proved each [mm].
  double since_search = std::numeric_limits<double>::infinity();
  FurtherStarts further;
};

}  // namespace bladefit
