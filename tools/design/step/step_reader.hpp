#pragma once
#include <filesystem>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// Reads the faces of all products of a STEP file (AP203, AP214, AP242), where the assembly places them. Faces that the
/// file hides, or that belong to no product's shape, are left out with a note.
/// Throws ToolError as read_design does.
DesignFile read_step(const std::filesystem::path& path);

}  // namespace bladefit
