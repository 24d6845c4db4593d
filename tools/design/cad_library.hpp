#pragma once
#include "tools/design/cad_module/cad_module.hpp"

namespace bladefit {

/// The module that reads CAD files, loaded at the first call: libbladefit_cad.so, beside the program's own libraries.
/// Throws ToolError where it, or OpenCASCADE, is not there, or where it belongs to another build.
/// Cost: 20 to 60 ms at the first call.
[[nodiscard]] const CadModule& cad_library();

}  // namespace bladefit
