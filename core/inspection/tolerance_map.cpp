#include "core/inspection/tolerance_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bladefit {
namespace {

/// How far (u, v) lies outside the box, in parameter units; 0 inside.
double outside(const ParameterBox& box, double u, double v) {
  return std::max({box.u_min - u, u - box.u_max, box.v_min - v, v - box.v_max, 0.0});
}

/// Bit z: the place lies in a box of zone z.
std::uint32_t zones_by_box(const ToleranceMap& map, std::uint32_t patch, double u, double v) {
  std::uint32_t zones = 0;
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    if (contains(map.boxes[k], patch, u, v)) zones |= 1U << map.boxes[k].zone;
  }
  return zones;
}

}  // namespace

std::uint32_t first_of_zone(const ToleranceMap& map, std::uint32_t k) {
  const std::uint32_t zone = map.boxes[k].zone;
  while (zone != 0 && k > 0 && map.boxes[k - 1].zone == zone) --k;
  return k;
}

bool sets_tolerance(const ToleranceMap& map) {
  if (std::isfinite(map.rest_mm)) return true;
  if (map.zone_count == 0) return std::isfinite(map.leading_edge_mm) && map.box_count > 0;
  const auto* const end = map.zones.begin() + map.zone_count;
  return std::any_of(map.zones.begin(), end, [](const ToleranceZone& z) { return std::isfinite(z.limits().nearer()); });
}

bool judges_everywhere(const ToleranceMap& map) {
  if (!std::isfinite(map.rest_mm)) return false;
  if (map.zone_count == 0) return std::isfinite(map.leading_edge_mm);
  const auto* const end = map.zones.begin() + map.zone_count;
  return std::all_of(map.zones.begin(), end,
                     [](const ToleranceZone& z) { return std::isfinite(z.limits().farther()); });
}

double tightest_of(const ToleranceMap& map, Region region) {
  if (map.zone_count == 0) return region == Region::leading_edge ? map.leading_edge_mm : map.rest_mm;
  double tightest = region == Region::rest ? map.rest_mm : std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < map.zone_count; ++k) {
    const ToleranceZone& zone = map.zones[k];
    if (zone.region == region) tightest = std::min(tightest, zone.limits().nearer());
  }
  return tightest;
}

MapPart part_at(const ToleranceMap& map, std::uint32_t patch, double u, double v, const Vec3& point) {
  if (map.zone_count == 0) return {region_at(map, patch, u, v), 0};
  const std::uint32_t by_box = zones_by_box(map, patch, u, v);
  const double radius = map.axis.radius_of(point);
  for (std::uint32_t k = 0; k < map.zone_count; ++k) {
    const ToleranceZone& zone = map.zones[k];
    const bool in_boxes = zone.everywhere || (by_box >> (k + 1) & 1U) != 0;
    if (in_boxes && zone.holds_radius(radius)) return {zone.region, static_cast<std::uint8_t>(k + 1)};
  }
  return {};
}

double tolerance_at(const ToleranceMap& map, Region region, std::uint32_t patch, double u, double v) {
  if (region == Region::leading_edge) return map.leading_edge_mm;
  if (!(map.transition > 0.0) || !std::isfinite(map.rest_mm) || !std::isfinite(map.leading_edge_mm)) return map.rest_mm;
  double share = 1.0;  // of the way from the leading edge's tolerance to the rest's
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    if (map.boxes[k].patch != patch) continue;
    const double distance = outside(map.boxes[k], u, v);
    if (distance < map.transition) share = std::min(share, distance / map.transition);
  }
  if (share == 1.0) return map.rest_mm;
  return map.leading_edge_mm + share * (map.rest_mm - map.leading_edge_mm);
}

}  // namespace bladefit
