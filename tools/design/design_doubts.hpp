#pragma once
#include <string>
#include <vector>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// One line that tells which faces are used up to the box of their bounds although these leave more of it out; empty
/// where there are none.
[[nodiscard]] std::string trim_warning(const DesignFile& design, const std::string& file);

/// What makes it doubtful that a design is what its maker meant, with figures; one line each: its size, slivers, gaps
/// between faces that nearly meet, faces left out.
[[nodiscard]] std::vector<std::string> design_doubts(const DesignFile& design);

}  // namespace bladefit
