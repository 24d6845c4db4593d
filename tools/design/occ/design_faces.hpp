#pragma once
#include "tools/design/nurbs/design_file.hpp"
#include "tools/design/occ/cad_face.hpp"

namespace bladefit {

/// Appends the surfaces of all faces to `design`, in the order of the file; of each that cannot be had, a line to
/// design.missing. To be called within with_cad_library().
void append_surfaces(const CadFaces& read, DesignFile& design);

}  // namespace bladefit
