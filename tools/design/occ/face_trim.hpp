#pragma once
#include <filesystem>
#include <string>
#include <vector>

class TopoDS_Shape;

namespace bladefit {

/// Whether a face of the shape on a B-spline surface is bounded inside the surface's natural bounds. A shape without
/// faces, which the CAD library could not make out of its entity, counts as trimmed: nobody knows that it is not.
[[nodiscard]] bool is_trimmed(const TopoDS_Shape& shape);

/// Names of the bounded entities (143, 144, 510) of an IGES file that are trimmed in this sense. To be called within
/// with_cad_library().
[[nodiscard]] std::vector<std::string> trimmed_iges_faces(const std::filesystem::path& path);

/// One line that tells which faces are used whole although they are trimmed; empty for no names.
[[nodiscard]] std::string trim_warning(const std::string& file, const std::vector<std::string>& names);

}  // namespace bladefit
