#pragma once
#include <array>
#include <cstdint>

#include "core/fit/quadratic_model.hpp"
#include "core/geometry/nearest/global_projection.hpp"
#include "core/inspection/verdict.hpp"

namespace bladefit {

/// A point that keeps its place in the localizer's memory.
struct StoredPoint {
  Vec3 position = Vec3::Zero(), approach = Vec3::Zero();  ///< machine coordinates
  Vec3 ranked_at = Vec3::Zero();  ///< where it stood [design coordinates] when it was last known which foot is nearest
  double weight = 1;              ///< in the least-squares objective
  Rivals rivals;                  ///< there
  Foot foot;                      ///< at the pose it was last projected at
  std::uint32_t span = 0;         ///< of the foot
  std::uint32_t sequence = 0, revision = 0;
  double tolerance = 0, uncertainty = 0;
  Region region = Region::rest;
  PointState state = PointState::pending, told_state = PointState::pending;  ///< told: what the caller knows
  Action action = Action::none, told_action = Action::none;
  bool queued = false;          ///< waits in the ring of revisions
  bool fresh = false;           ///< its row is taken anew in every push
  bool outside_window = false;  ///< does not count in the fit
  bool held_out = false;        ///< nor does it beyond least squares: its foot was on an edge then
  std::uint8_t exits = 0;       ///< how often it was left out by the present refinement after it had counted
};

/// Sums over the points of one region, at the poses they were last projected at.
struct RegionSums {
  std::uint32_t count = 0;
  double square = 0;  ///< sum d^2 [mm^2]
  double worst = 0;   ///< signed [mm]
  std::uint32_t worst_sequence = 0;

  void add(double distance, std::uint32_t sequence) {
    ++count;
    square += distance * distance;
    const double magnitude = distance < 0.0 ? -distance : distance;
    if (worst_sequence != 0 && magnitude <= (worst < 0.0 ? -worst : worst)) return;
    worst = distance;
    worst_sequence = sequence;
  }
};

/// Everything that is summed over the points. Nothing is ever subtracted, so rounding does not build up: a sweep over
/// the stored points fills a new set, which then takes the place of the old one.
struct FitSums {
  QuadraticModel model;
  std::array<RegionSums, 2> regions;
};

}  // namespace bladefit
