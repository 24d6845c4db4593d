#include "core/inspection/tolerance_map.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// How far (u, v) lies outside the box, in parameter units; 0 inside.
double outside(const ParameterBox& box, double u, double v) {
  return std::max({box.u_min - u, u - box.u_max, box.v_min - v, v - box.v_max, 0.0});
}

}  // namespace

std::uint32_t first_of_zone(const ToleranceMap& map, std::uint32_t k) {
  const std::uint32_t zone = map.boxes[k].zone;
  while (zone != 0 && k > 0 && map.boxes[k - 1].zone == zone) --k;
  return k;
}

bool sets_tolerance(const ToleranceMap& map) {
  return std::isfinite(map.rest_mm) || (std::isfinite(map.leading_edge_mm) && map.box_count > 0);
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
