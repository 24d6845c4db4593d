#pragma once
#include <string>
#include <vector>

#include "tools/panel/screen.hpp"

namespace bladefit {

/// What an engineer looks at: the fit, the pose, both regions, the newest leading-edge points that are out.
[[nodiscard]] std::vector<std::string> figures_page(const ScreenView& view, int width, int height);

/// The fit's state; in the modes beside least squares also whether its optimum still moves.
[[nodiscard]] std::string fit_words(const PanelState& state);

/// "-0.323 mm at point 1312"; "-" where there is no point.
[[nodiscard]] std::string worst_words(float distance, std::uint32_t sequence);

}  // namespace bladefit
