#pragma once
#include "tools/panel/page.hpp"

namespace bladefit {

/// What is wrong beside the blade, since when, why, and what to do about it; nothing where all is well.
void put_trouble(const ScreenView& view, Page& page, int height);

}  // namespace bladefit
