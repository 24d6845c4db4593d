#include "tools/web/edge_limits.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace bladefit {
namespace {

/// Radii that a zone reaches; none where low is above high.
struct Reach {
  double low = std::numeric_limits<double>::infinity(), high = 0;
};

Reach reach_of(const ToleranceMap& map, std::span<const FaceMesh> zones, std::uint32_t number) {
  const ToleranceZone& zone = map.zones.at(number - 1);
  if (zone.everywhere) return {zone.radius_low_mm, zone.radius_high_mm};
  Reach reach;
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    if (map.boxes.at(k).zone != number) continue;
    for (const Vec3& point : zones[k].points) {
      const double radius = map.axis.radius_of(point);
      reach = {std::min(reach.low, radius), std::max(reach.high, radius)};
    }
  }
  return {std::max(reach.low, zone.radius_low_mm), std::min(reach.high, zone.radius_high_mm)};
}

}  // namespace

std::vector<EdgeLimits> edge_limits(const ToleranceMap& map, std::span<const FaceMesh> zones) {
  std::array<Reach, ToleranceMap::kMaxZones> reaches;
  std::vector<double> ends;
  for (std::uint32_t k = 0; k < map.zone_count; ++k) {
    reaches.at(k) = reach_of(map, zones, k + 1);
    ends.insert(ends.end(), {reaches.at(k).low, reaches.at(k).high});
  }
  std::ranges::sort(ends);
  std::vector<EdgeLimits> pieces;
  std::uint32_t last = map.zone_count;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double low = ends[i - 1], high = ends[i];
    if (!(low < high)) continue;
    std::uint32_t first = 0;
    while (first < map.zone_count && !(reaches.at(first).low <= low && high <= reaches.at(first).high)) ++first;
    const bool edge = first < map.zone_count && map.zones.at(first).region == Region::leading_edge;
    if (edge && first == last) {
      pieces.back().high_mm = high;
    } else if (edge) {
      pieces.push_back({low, high, map.zones.at(first).limits()});
    }
    last = edge ? first : map.zone_count;
  }
  return pieces;
}

}  // namespace bladefit
