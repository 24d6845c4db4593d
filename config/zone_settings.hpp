#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/fit_text.hpp"
#include "config/length.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Radii between two shares of R, both included: r/R 0.7:1.0.
struct RadiusBand {
  double low = 0, high = 0;
};

/// Where a zone is: parts of the leading edge, a band of radii, or those parts within that band.
struct ZonePlace {
  std::vector<EdgeZone> edges;  ///< empty: the whole band
  std::optional<RadiusBand> band;
};

/// One table [[zone]]: a part of the blade with tolerances of its own.
struct ZoneSettings {
  std::string name;
  std::string where;  ///< as it was given
  ZonePlace place;
  Length plus, minus;  ///< allowed excess and missing material, both above 0
};

/// Largest r/R of a band, and characters of a name.
inline constexpr double kLargestBand = 1.2;
inline constexpr std::size_t kMostZoneName = 60;
/// Keys of the limits, in files of settings and of results.
inline constexpr const char *kPlusKey = "plus", *kMinusKey = "minus";
/// The name of what is outside of all zones.
inline constexpr std::string_view kRestName = "rest";

/// Words with blanks between them: zones of the leading edge, as parse_edge_zone() takes each, and `r/R 0.7:1.0`, one
/// or the other or both. Error: a line that names the text and the fix.
[[nodiscard]] Failure parse_zone_place(std::string_view text, ZonePlace& place);

}  // namespace bladefit
