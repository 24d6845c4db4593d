#include "tools/panel/worst_place.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/panel/panel_words.hpp"

namespace bladefit {
namespace {

/// In tolerances, where there is a point and a tolerance.
float in_tolerances(float distance, std::uint32_t sequence, float tolerance) {
  if (sequence == 0 || !(tolerance > 0)) return 0;
  return std::abs(distance) / tolerance;
}

}  // namespace

std::optional<WorstPlace> worst_place(const PanelState& state) {
  const BladeDefect& defect = state.blade.defects[0];
  if (state.has_blade && defect.sequence != 0)
    return WorstPlace{defect.sequence, defect.distance, defect.region, defect.action, &defect};
  const float edge =
      in_tolerances(state.worst_leading_edge, state.worst_leading_edge_sequence, state.leading_edge_tolerance);
  const float rest = in_tolerances(state.worst_rest, state.worst_rest_sequence, state.rest_tolerance);
  const bool at_rest = rest > edge || state.worst_leading_edge_sequence == 0;
  const std::uint32_t sequence = at_rest ? state.worst_rest_sequence : state.worst_leading_edge_sequence;
  if (sequence == 0) return std::nullopt;
  const float distance = at_rest ? state.worst_rest : state.worst_leading_edge;
  const bool out = (at_rest ? state.rest_out : state.leading_edge_out) > 0;
  const Action action = !out ? Action::none : distance > 0 ? Action::cut : Action::weld;
  return WorstPlace{sequence, distance, at_rest ? Region::rest : Region::leading_edge, action, nullptr};
}

std::string where_words(Region region, BladeSide side) {
  const std::string name = side_word(side);
  if (region == Region::leading_edge) return name.empty() ? "leading edge" : "leading edge, " + name;
  return name.empty() ? region_word(region) : name + " side";
}

std::string span_words(const BladeView& blade, float ratio) {
  constexpr float kNear = 0.2F;
  if (!(blade.edge_tip > blade.edge_root) || !(blade.tip > 0)) return "";
  const float share = (ratio * blade.tip - blade.edge_root) / (blade.edge_tip - blade.edge_root);
  if (share < kNear) return "near the root";
  return share > 1 - kNear ? "near the tip" : "mid-span";
}

std::string machine_words(const std::array<float, 3>& place) {
  return fmt::format("x {}  y {}  z {} mm", machine_mm(place[0]), machine_mm(place[1]), machine_mm(place[2]));
}

}  // namespace bladefit
