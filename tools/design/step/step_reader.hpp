#pragma once
#include <filesystem>

#include "tools/design/nurbs/design_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

/// Every B-spline surface of a STEP file, control points as they stand there, turned to mm: in the order of the faces
/// named PATCH1, PATCH2, ... where all their faces are so named, else of the file. Surfaces are not checked yet.
/// Throws ToolError.
DesignFile read_step(const std::filesystem::path& path);

}  // namespace bladefit
