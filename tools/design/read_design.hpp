#pragma once
#include <filesystem>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// Reads the faces of `path` (.igs .iges .stp .step .p21 .stpz, in any case of letters, and the same with .gz) as NURBS
/// surfaces: in the order of the file, those of STEP in the order of the faces named PATCH1, PATCH2, ... where all are
/// named so. A CAD system writes its faces in the same order to both kinds, so that they have the same numbers. Throws
/// ToolError where the file cannot be read, is damaged, holds no face, names an unknown unit, or a surface is not
/// valid. Faces that cannot be had are listed in `missing`.
DesignFile read_design(const std::filesystem::path& path);

}  // namespace bladefit
