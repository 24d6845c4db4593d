#pragma once
#include <vector>

#include "core/inspection/tolerance_map.hpp"
#include "tools/design/ridge/blade_ridges.hpp"

namespace bladefit {

/// How far a zone reaches from its ridge.
struct ZoneReach {
  double amount = 0;  ///< along the section on either side [mm], or in per cent of its chord
  bool percent = false;
};

/// A zone about a ridge as the localizer takes it.
struct RidgeZone {
  std::vector<ParameterBox> boxes;
  double error_mm = 0;                           ///< how far a limit of a box is from that of the zone, at most
  double least_reach_mm = 0, most_reach_mm = 0;  ///< over the sections
  double least_chord_mm = 0, most_chord_mm = 0;
  bool clipped = false;  ///< in some section a side ends, or the other ridge comes, before the reach
};

/// The zone about a ridge of a blade: in each section what is within the reach along it, on all patches that the
/// section crosses there, but no farther than the other ridge or the end of the section. Sections are put together to
/// at most `most_boxes` boxes, so that limits are off by as little as can be. Cost: linear in the points of the
/// sections.
[[nodiscard]] RidgeZone ridge_zone(const Surface& surface, const RidgedBlade& blade, std::size_t ridge,
                                   const ZoneReach& reach, std::size_t most_boxes);

}  // namespace bladefit
