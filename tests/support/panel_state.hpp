#pragma once
#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit::testing {

/// Places of the blade, each value different from the others.
inline BladeView known_blade() {
  BladeView blade;
  for (std::size_t cell = 0; cell < 60; ++cell) blade.edge[cell] = EdgeCell::in;
  blade.edge[20] = blade.edge[21] = EdgeCell::cut;
  blade.edge[40] = EdgeCell::weld;
  blade.edge[50] = EdgeCell::pending;
  blade.edge_root = 30.5F;
  blade.edge_tip = 152.25F;
  blade.tip = 152.5F;
  blade.suction = {BladeView::kNoSurface, BladeView::kNoSurface, 12, 30, 31, 32, 0, 0, 0, 0};
  blade.pressure = {BladeView::kNoSurface, BladeView::kNoSurface, 0, 20, 21, 22, 23, 0, 0, 0};
  blade.next = {NextReason::edge_not_probed, BladeSide::nose, 0.84F, {-11.5F, 88.25F, 91.125F}};
  blade.defect_count = 21;
  for (std::size_t row = 0; row < BladeView::kDefects; ++row) {
    const auto number = static_cast<float>(row);
    blade.defects[row] = {.sequence = 90000 + static_cast<std::uint32_t>(row),
                          .from_ratio = 0.3F + 0.01F * number,
                          .to_ratio = 0.31F + 0.01F * number,
                          .length = 4.5F + number,
                          .distance = row % 2 == 0 ? 0.5F - 0.01F * number : -0.5F + 0.01F * number,
                          .side = static_cast<BladeSide>(row % 4),
                          .action = row % 2 == 0 ? Action::cut : Action::weld,
                          .region = row < 12 ? Region::leading_edge : Region::rest,
                          .points = static_cast<std::uint16_t>(3 + row),
                          .machine = {-39.5F - number, 24.5F + number, 130.25F + number}};
  }
  return blade;
}

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
  state.otherwise_count = 71150;
  state.otherwise = {71152, 71154};
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
  state.has_extension = state.has_blade = true;
  state.link_down_s = 75;
  state.lost = 70108;
  state.texts[kSourceText] = "modbus-tcp://127.0.0.1:1502";
  state.texts[kFaultText] = "modbus-tcp://127.0.0.1:1502: no answer within 500 ms; check the cable and the machine";
  state.texts[kLossText] = "records 17 to 19 were overwritten in the device before they were read";
  state.blade = known_blade();
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
