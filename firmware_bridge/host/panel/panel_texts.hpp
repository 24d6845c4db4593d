#pragma once
#include <string>

#include "core/inspection/verdict.hpp"
#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// "NOT DECIDED: needs more points, not finished".
[[nodiscard]] std::string verdict_words(const PanelState& state);

/// "point 1312 leading edge -0.323 mm WELD radius 117.0 mm u 0.4839 v 0.6480"; empty where there is no point. At most
/// 80 characters.
[[nodiscard]] std::string worst_words(const Verdict* worst, double radius_mm);

/// The next thing to do, in at most 80 characters.
[[nodiscard]] std::string advice_words(const PanelState& state);

}  // namespace bladefit
