#pragma once
#include <cstdint>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/inspection/verdict.hpp"

namespace bladefit {

/// A point that keeps its place in the localizer's memory.
struct StoredPoint {
  Vec3 position = Vec3::Zero(), approach = Vec3::Zero();  ///< machine coordinates
  Vec3 ranked_at = Vec3::Zero();  ///< where it stood [design coordinates] when it was last known which foot is nearest
  double weight = 1;              ///< in the least-squares objective
  RunnerUp runner_up;             ///< there
  Foot foot;                      ///< at the pose it was last projected at
  std::uint32_t span = 0;         ///< of the foot
  std::uint32_t sequence = 0, revision = 0;
  double tolerance = 0, uncertainty = 0, expanded = 0;
  Region region = Region::rest;
  std::uint8_t zone = 0;                                                         ///< as that of a verdict
  PointState state = PointState::pending, reported_state = PointState::pending;  ///< reported: what the caller knows
  Action action = Action::none, reported_action = Action::none;
  bool queued = false;  ///< waits in the ring of revisions
  bool recent = false;  ///< its row is taken again in every push
  LeftOut left_out = LeftOut::none;
  bool fitted = false;          ///< counted in the fit when it was judged
  bool outside_window = false;  ///< neither counts in the fit nor is judged
  bool held_out = false;        ///< does not count beyond least squares: its foot was on an edge then
  std::uint8_t exits = 0;       ///< how often it was left out by the present refinement after it had counted
};

}  // namespace bladefit
