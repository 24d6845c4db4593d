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

/// A foot that was tracked in a lane and needs no search.
struct LaneFoot {
  const LaneBlock* block;
  std::uint32_t lane;
  bool proven_nearest;  ///< by its reach

  [[nodiscard]] const SurfacePlace& place() const { return block->feet.place(lane); }
  void write_to(Foot& foot, const Surface& surface) const {
    foot = Foot();
    foot.patch = surface.span(place().span).patch;
    foot.u = place().u;
    foot.v = place().v;
    foot.point = block->feet.surface_point(lane);
    foot.normal = lane_of(block->rows.normal, lane);
    foot.distance = block->rows.distance[lane];
  }
};

/// A stored point at a pose.
struct Measurement {
  SurfacePlace place;  ///< of the foot
  Projection alone;    ///< where it is in no lane
  Foot foot;
  Vec3 r = Vec3::Zero();  ///< the point in design coordinates [mm]
  bool searched = false;  ///< the foot is the outcome of a global search
  bool changed = false;   ///< it is not the local minimum that was tracked
  bool ranked = false;    ///< `runner_up` is that of this place: it was searched, or weighed against its runner-up
  RunnerUp runner_up;
  bool proven = true;                ///< false: the search met its cap
  const LaneBlock* block = nullptr;  ///< where its projection and its row are already computed, and in which lane
  std::uint32_t lane = 0;

  [[nodiscard]] Projection projection() const { return block == nullptr ? alone : block->feet.projection(lane); }
};

}  // namespace bladefit
