#include "tools/design/cad_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string_view>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr const char* kWayOn = "install it with the command, or give a compiled design (.bfd)";

const CadModule& load_module() {
  void* const library = dlopen(kCadModuleFile, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw ToolError(
        fmt::format("{}, which reads CAD files, cannot be loaded ({}); {}", kCadModuleFile, dlerror(), kWayOn),
        ToolError::Kind::device);
  }
  void* const entry = dlsym(library, kCadModuleEntry);
  const CadModule* const module =
      entry == nullptr ? nullptr : reinterpret_cast<decltype(&bladefit_cad_module)>(entry)();
  if (module == nullptr || std::string_view(module->version) != BLADEFIT_VERSION) {
    throw ToolError(fmt::format("{}, which reads CAD files, is of version {}, the command of {}; {}", kCadModuleFile,
                                module == nullptr ? "unknown" : module->version, BLADEFIT_VERSION, kWayOn),
                    ToolError::Kind::device);
  }
  return *module;
}

}  // namespace

const CadModule& cad_library() {
  static const CadModule& module = load_module();
  return module;
}

}  // namespace bladefit
