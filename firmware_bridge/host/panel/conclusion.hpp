#pragma once
#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// What a session came to when it has ended, as the panel goes on showing it.
struct Conclusion {
  BladeVerdict verdict;
  std::uint32_t otherwise_count = 0;                    ///< points that a robust fit judges otherwise
  std::array<std::uint32_t, kPanelListed> otherwise{};  ///< the first of them; 0 = no more
};

}  // namespace bladefit
