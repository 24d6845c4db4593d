#pragma once
#include <filesystem>

#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// What the module offers in which OpenCASCADE is linked. It is loaded where a CAD file is read, and only there:
/// loading OpenCASCADE takes longer than most commands do, and who has compiled designs alone needs none of it.
struct CadModule {
  const char* version;      ///< of the build that it belongs to; another one is not used
  const char* opencascade;  ///< version of the library
  DesignFile (*read_iges)(const std::filesystem::path& path);
  DesignFile (*read_step)(const std::filesystem::path& path);
};

inline constexpr const char* kCadModuleFile = "libbladefit_cad.so";
inline constexpr const char* kCadModuleEntry = "bladefit_cad_module";

}  // namespace bladefit

/// The one name that the module exports.
extern "C" const bladefit::CadModule* bladefit_cad_module();
