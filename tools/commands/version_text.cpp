#include "tools/commands/version_text.hpp"

#include <fmt/format.h>

#include "core/geometry/simd/lanes.hpp"
#include "tools/commands/commit.hpp"
#include "tools/design/cad_library.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

std::string cad_text() {
  try {
    return fmt::format("OpenCASCADE {}: reads IGES and STEP", cad_library().opencascade);
  } catch (const ToolError& error) {
    return fmt::format("without OpenCASCADE: {}", error.what());
  }
}

}  // namespace

std::string version_text() {
  return fmt::format("bladefit {} ({})\nprocessor: {}; the results are the same bits\n{}\n", BLADEFIT_VERSION, kCommit,
                     lanes_available() ? "AVX2, four points at once" : "no AVX2, one point at a time", cad_text());
}

}  // namespace bladefit
