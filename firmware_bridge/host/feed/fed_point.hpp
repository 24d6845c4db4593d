#pragma once
#include <array>
#include <cstdint>

#include "core/inspection/verdict.hpp"

namespace bladefit {

/// What a point was judged at one time. Lengths in mm.
struct FedVerdict {
  std::uint32_t sequence = 0;
  std::uint32_t time_ms = 0;  ///< since the feed was made
  float distance = 0;
  float tolerance = 0;  ///< infinity where none is set
  float uncertainty = 0;
  std::uint32_t revision = 0;  ///< of the fit
  PointState state = PointState::pending;
  Action action = Action::none;
  Region region = Region::rest;
};

/// A point as it was judged last.
struct FedPoint {
  FedVerdict verdict;
  std::uint32_t slot = 0;         ///< the place that it has in the feed, and that another point may have later
  std::array<float, 3> foot{};    ///< in the frame of the design [mm]
  std::array<float, 3> normal{};  ///< outward unit vector there; zero where the point has no foot
};

}  // namespace bladefit
