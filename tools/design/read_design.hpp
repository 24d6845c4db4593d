#pragma once
#include <filesystem>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// Reads the B-spline surfaces of `path` (.igs .iges .stp .step, in any case of letters): those of IGES in the order of
/// the file, those of STEP in the order of the faces named PATCH1, PATCH2, ... or else of the file.
/// Throws ToolError where the file cannot be read, is damaged, holds no B-spline surface, names an unknown unit, or a
/// surface is not valid.
DesignFile read_design(const std::filesystem::path& path);

}  // namespace bladefit
