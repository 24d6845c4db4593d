#pragma once
#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit::testing {

/// A state in which every field has a value of its own, named after its register.
inline PanelState known_state() {
  PanelState state;
  state.session = SessionState::tracking;
  state.fit_status = 1;
  state.alarms = kAlarmLeadingEdgeOut | kAlarmLinkLost;
  state.points = 70001;
  state.leading_edge_points = 70002;
  state.leading_edge_out = 70003;
  state.rest_out = 70004;
  state.rejected = 70005;
  state.rms = 0.014F;
  state.leading_edge_rms = 0.016F;
  state.worst_leading_edge = -0.018F;
  state.worst_leading_edge_sequence = 70020;
  state.worst_rest = 0.022F;
  state.worst_rest_sequence = 70024;
  state.pose = {26.0F, 28.0F, 30.0F, 32.0F, 34.0F, 36.0F};
  state.last_sequence = 70038;
  state.last_distance = 0.040F;
  state.last_state = PointState::out;
  state.last_action = Action::cut;
  state.last_region = Region::leading_edge;
  state.leading_edge_tolerance = 0.045F;
  state.rest_tolerance = 0.047F;
  state.push_latency_us = 4.9F;
  state.heartbeat = 51;
  state.determined = 6;
  state.fit_determined = true;
  state.verdict = BladeState::out_of_tolerance;
  state.reasons = kReasonPointsMissing;
  state.has_extension = true;
  for (std::size_t place = 0; place < kPanelPlaces; ++place) {
    const auto number = static_cast<float>(place);
    state.newest[place] = {.sequence = 80000 + static_cast<std::uint32_t>(place),
                           .distance = 0.5F + number,
                           .patch = static_cast<std::uint16_t>(place),
                           .u = 0.1F * number,
                           .v = 0.2F * number,
                           .radius = 100.0F + number,
                           .action = place % 2 == 0 ? Action::cut : Action::weld};
  }
  return state;
}

}  // namespace bladefit::testing
