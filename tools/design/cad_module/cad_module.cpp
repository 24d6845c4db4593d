#include "tools/design/cad_module/cad_module.hpp"

#include <Standard_Version.hxx>

#include "tools/design/iges/iges_reader.hpp"
#include "tools/design/step/step_reader.hpp"

extern "C" __attribute__((visibility("default"))) const bladefit::CadModule* bladefit_cad_module() {
  static constexpr bladefit::CadModule kModule{BLADEFIT_VERSION, OCC_VERSION_COMPLETE, bladefit::read_iges,
                                               bladefit::read_step};
  return &kModule;
}
