#pragma once
#include <string>
#include <vector>

#include "tools/panel/screen.hpp"

namespace bladefit {

/// Four lines, to be read from some metres: the verdict, the worst distance, where it is, how far the probing is or
/// what is in its way. In block letters as large as the screen allows; in plain ones where it allows none.
[[nodiscard]] std::vector<std::string> big_page(const ScreenView& view, int width, int height);

}  // namespace bladefit
