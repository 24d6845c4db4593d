#pragma once
#include <cstdint>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/nearest/lane_projection.hpp"

namespace bladefit {

/// Stored points that are tracked at once, one a lane, with the rows of those that end on a smooth foot.
struct LaneBlock {
  LaneProjections feet;
  LaneRows rows;
};

/// A stored point at a pose.
struct Measurement {
  Projection projection;
  Foot foot;
  Vec3 r = Vec3::Zero();  ///< the point in design coordinates [mm]
  bool searched = false;  ///< the foot is the outcome of a global search
  bool changed = false;   ///< it is not the local minimum that was tracked
  bool ranked = false;    ///< `runner_up` is that of this place: it was searched, or weighed against its runner-up
  RunnerUp runner_up;
  bool proven = true;                ///< false: the search met its cap
  const LaneBlock* block = nullptr;  ///< where its row is already computed, and in which lane
  std::uint32_t lane = 0;
};

}  // namespace bladefit
