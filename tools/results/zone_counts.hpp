#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/results/result.hpp"

namespace bladefit {

/// What the points of one zone came to.
struct ZoneCounts {
  std::uint32_t points = 0;  ///< with a foot in it, rejected ones left out
  std::uint32_t in = 0, cut = 0, weld = 0;
  std::uint32_t beyond = 0;  ///< out beyond an outer edge of the design, where neither is proven
  std::uint32_t open = 0;    ///< pending or undecided
  double most = 0;           ///< largest distance, above 0 where there is excess material [mm]
  double least = 0;          ///< smallest one

  [[nodiscard]] std::uint32_t out() const { return cut + weld + beyond; }
};

/// Of each zone of a result, and last of what lies outside of all. Cost: linear in the points.
[[nodiscard]] std::vector<ZoneCounts> zone_counts(const Result& result);

/// Its name, by the number of a point's zone: from 1, 0 is the rest.
[[nodiscard]] std::string zone_name(const Result& result, std::uint32_t zone);

/// The zones of a result, and last the rest of the blade with its tolerance on both sides; empty where there are none.
[[nodiscard]] std::vector<ResultZone> zones_and_rest(const Result& result);

/// By what the tolerances of zones and rest can be multiplied so that some pose just meets them, as the modes
/// min_tolerance and constrained find it. What is allowed on either side of a zone is multiplied alike.
struct ZoneShare {
  double factor = 0;                     ///< 0: not sought, or there are no zones
  double tightest = 0;                   ///< the tolerance [mm] that Result::tolerance_factor is a multiple of: the
  Region region = Region::leading_edge;  ///< smallest of this region, on either side
};
[[nodiscard]] ZoneShare zone_share(const Result& result);

}  // namespace bladefit
