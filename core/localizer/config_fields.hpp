#pragma once
#include <algorithm>
#include <cstdint>

#include "core/localizer.hpp"

namespace bladefit {

/// The part of for_each_field() that is of zones.
template <class Zones, class Count, class Axis, class Visit>
void visit_zones(Zones& zones, Count& zone_count, Axis& axis, Visit& visit) {
  if (zone_count == 0) return;
  visit("tolerance.zone_count", zone_count);
  const std::uint32_t zones_in_use = std::min(zone_count, std::uint32_t{ToleranceMap::kMaxZones});
  for (std::uint32_t k = 0; k < zones_in_use; ++k) {
    auto& [region, everywhere, radius_low_mm, radius_high_mm, plus_mm, minus_mm] = zones[k];
    visit("tolerance.zones.region", region);
    visit("tolerance.zones.everywhere", everywhere);
    visit("tolerance.zones.radius_low_mm", radius_low_mm);
    visit("tolerance.zones.radius_high_mm", radius_high_mm);
    visit("tolerance.zones.plus_mm", plus_mm);
    visit("tolerance.zones.minus_mm", minus_mm);
  }
  auto& [point, direction] = axis;
  for (auto& entry : point.reshaped()) visit("tolerance.axis.point", entry);
  for (auto& entry : direction.reshaped()) visit("tolerance.axis.direction", entry);
}

/// Calls visit(name, field) for every number, choice and flag of a configuration; of the leading-edge boxes and of the
/// zones for those in use, of the boxes' zones those that have a number, and the axis where there are zones. The names
/// are the members' paths, such as "tolerance.rest_mm". `Config` is LocalizerConfig, const or not: a visitor of one
/// that is not const may change the fields. A member that is added to one of the structs and is missing here does not
/// compile, since a structured binding names all members.
template <class Config, class Visit>
void for_each_field(Config& config, Visit&& visit) {
  auto& [capacity, refresh_per_push, probe_radius_mm, use_approach, edges, noise_floor_mm, determined_mm, start,
         window_low, window_high, tolerance, decision, mode, ratio, regions, locked, loss, loss_scale_mm,
         further_starts] = config;
  visit("capacity", capacity);
  visit("refresh_per_push", refresh_per_push);
  visit("probe_radius_mm", probe_radius_mm);
  visit("use_approach", use_approach);
  visit("edges", edges);
  visit("noise_floor_mm", noise_floor_mm);
  visit("determined_mm", determined_mm);
  auto& [rotation, translation] = start;
  for (auto& entry : rotation.reshaped()) visit("start.rotation", entry);
  for (auto& entry : translation.reshaped()) visit("start.translation", entry);
  visit("window_low", window_low);
  visit("window_high", window_high);
  auto& [boxes, box_count, leading_edge_mm, rest_mm, transition, least_points, zones, zone_count, axis] = tolerance;
  visit("tolerance.box_count", box_count);
  const std::uint32_t boxes_in_use = std::min(box_count, std::uint32_t{ToleranceMap::kMaxBoxes});
  for (std::uint32_t k = 0; k < boxes_in_use; ++k) {
    auto& [patch, u_min, u_max, v_min, v_max, zone] = boxes[k];
    visit("tolerance.boxes.patch", patch);
    visit("tolerance.boxes.u_min", u_min);
    visit("tolerance.boxes.u_max", u_max);
    visit("tolerance.boxes.v_min", v_min);
    visit("tolerance.boxes.v_max", v_max);
    if (zone != 0) visit("tolerance.boxes.zone", zone);
  }
  visit("tolerance.leading_edge_mm", leading_edge_mm);
  visit("tolerance.rest_mm", rest_mm);
  visit("tolerance.transition", transition);
  visit("tolerance.least_points", least_points);
  visit_zones(zones, zone_count, axis, visit);
  auto& [rule, coverage_factor, probe_mm, probe_per_mm] = decision;
  visit("decision.rule", rule);
  visit("decision.coverage_factor", coverage_factor);
  visit("decision.probe_mm", probe_mm);
  visit("decision.probe_per_mm", probe_per_mm);
  visit("mode", mode);
  visit("ratio", ratio);
  visit("regions", regions);
  visit("locked", locked);
  visit("loss", loss);
  visit("loss_scale_mm", loss_scale_mm);
  visit("further_starts", further_starts);
}

}  // namespace bladefit
