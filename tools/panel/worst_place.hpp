#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// The point that is farthest off in tolerances.
struct WorstPlace {
  std::uint32_t sequence = 0;
  float distance = 0;  ///< [mm]
  Region region = Region::rest;
  Action action = Action::none;
  const BladeDefect* defect = nullptr;  ///< that it is the worst point of; null: it is in, or that is not known
};

/// Nothing where there is no point.
[[nodiscard]] std::optional<WorstPlace> worst_place(const PanelState& state);

/// "leading edge, nose", "suction side".
[[nodiscard]] std::string where_words(Region region, BladeSide side);

/// "near the tip", "near the root", "mid-span": by the share of the way from root to tip.
[[nodiscard]] std::string span_words(const BladeView& blade, float ratio);

/// "x -39.2  y +24.5  z +30.1 mm".
[[nodiscard]] std::string machine_words(const std::array<float, 3>& place);

}  // namespace bladefit
