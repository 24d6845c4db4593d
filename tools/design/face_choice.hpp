#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// "3 (SUCTION_SIDE)", or the number alone.
[[nodiscard]] std::string face_title(const DesignFile& design, std::size_t face);

/// The faces that `pattern` means: a number as `compile --list` shows it, a name, or a pattern of names or layers with
/// * and ?. Throws ToolError where there is none.
[[nodiscard]] std::vector<std::size_t> faces_named(const DesignFile& design, std::string_view pattern,
                                                   const std::string& file);

/// Keeps the faces that one of `patterns` means, in the order of the file. Throws ToolError as faces_named does.
void keep_faces(DesignFile& design, const std::vector<std::string>& patterns, const std::string& file);

/// Keeps the faces of these numbers, which rise.
void keep_numbers(DesignFile& design, const std::vector<std::size_t>& numbers);

/// Leaves out trimmed planes beside other faces, with a line to the warnings: the root and the tip of a solid model,
/// which close the blade where it was cut off. With them points beyond that cut would be judged by the cut. Not where
/// they are more than a fifth of the area: then they are sides of the blade.
void leave_flat_caps(DesignFile& design);

/// Throws ToolError that lists the faces which could not be read, with their share of the design.
void refuse_missing(const DesignFile& design, const std::string& file);

}  // namespace bladefit
