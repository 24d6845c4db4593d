#pragma once
#include <filesystem>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// Reads the visible surfaces, bounded surfaces and solids of an IGES file, where their matrices and those of their
/// owners place them, in the order of the directory. What counts as hidden is the status of the independent entity.
/// Throws ToolError as read_design does.
DesignFile read_iges(const std::filesystem::path& path);

}  // namespace bladefit
