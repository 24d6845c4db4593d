#pragma once
#include <string>
#include <vector>

#include "tools/panel/screen.hpp"

namespace bladefit {

/// What the operator sees, the most important on top.
[[nodiscard]] std::vector<std::string> operator_page(const ScreenView& view, int width, int height);

}  // namespace bladefit
