#pragma once
#include <filesystem>

#include "tools/design/nurbs/design_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

/// Every entity 128 of an IGES file, in the order of its directory: control points as they stand there, moved by the
/// entity's transformation matrix and turned to mm. Surfaces are not checked yet. Throws ToolError.
/// Read from the text and not by OpenCASCADE, whose release 7.6 swaps U1 and V0, takes units that it does not know for
/// inches, and replaces weights that are not above 0.
DesignFile read_iges(const std::filesystem::path& path);

}  // namespace bladefit
