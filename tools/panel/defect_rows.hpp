#pragma once
#include "tools/panel/page.hpp"

namespace bladefit {

/// What is to be cut or welded, a row each, the worst first, with a heading: `rows` lines in all.
void put_defects(const ScreenView& view, Page& page, int rows);

}  // namespace bladefit
