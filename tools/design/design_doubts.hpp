#pragma once
#include <string>
#include <vector>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// One line that tells which faces are used up to the box of their bounds, since these cannot be made out; empty where
/// there are none.
[[nodiscard]] std::string trim_warning(const DesignFile& design, const std::string& file);

/// One line on how many faces are trimmed, and how near to the file's curves; empty where there are none.
[[nodiscard]] std::string trim_note(const DesignFile& design);

/// What makes it doubtful that a design is what its maker meant, with figures; one line each: its size, slivers, gaps
/// between faces that nearly meet, faces left out.
[[nodiscard]] std::vector<std::string> design_doubts(const DesignFile& design);

}  // namespace bladefit
