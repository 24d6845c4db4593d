#pragma once
#include <string>
#include <vector>

#include "tools/panel/page.hpp"

namespace bladefit {

/// How far the probing is, what has no point yet, and where to probe next.
void put_progress(const ScreenView& view, Page& page);

/// Stretches of the blade without points: "leading edge r/R 0.82-1.00", "suction side r/R 0.6-1.0".
[[nodiscard]] std::vector<std::string> not_probed(const BladeView& blade);

/// Seconds until all planned points are there; below 0 where that is not known.
[[nodiscard]] double seconds_left(const ScreenView& view);

}  // namespace bladefit
