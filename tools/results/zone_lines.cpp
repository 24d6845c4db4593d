#include "tools/results/zone_lines.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/results/zone_counts.hpp"

namespace bladefit {

std::string zone_lines(const Result& result) {
  const std::vector<ResultZone> zones = zones_and_rest(result);
  const std::vector<ZoneCounts> counts = zone_counts(result);
  std::string text;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const ResultZone& zone = zones[k];
    const ZoneCounts& points = counts[k];
    const bool judged = std::isfinite(zone.plus) || std::isfinite(zone.minus);
    text += fmt::format("Zone {} ({}): ", zone.name, zone.where);
    text += judged ? fmt::format("+{:.3f} -{:.3f} {}", result.in_units(zone.plus), result.in_units(zone.minus),
                                 result.units)
                   : std::string("not judged");
    text += fmt::format("; {} {}, {} out ({} cut, {} weld), {} open", points.points,
                        points.points == 1 ? "point" : "points", points.out(), points.cut, points.weld, points.open);
    if (points.points > 0) {
      text += fmt::format("; from {:+.3f} to {:+.3f} {}", result.in_units(points.least), result.in_units(points.most),
                          result.units);
    }
    text += "\n";
  }
  return text;
}

}  // namespace bladefit
