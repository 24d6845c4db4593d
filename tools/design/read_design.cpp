#include "tools/design/read_design.hpp"

#include <fmt/format.h>

#include "tools/design/iges/iges_reader.hpp"
#include "tools/design/step/step_reader.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

DesignFile read_unchecked(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".igs" || extension == ".iges") return read_iges(path);
  if (extension == ".stp" || extension == ".step") return read_step(path);
  throw ToolError(fmt::format("{}: unknown kind of design \"{}\"; give a file named .igs, .iges, .stp or .step",
                              path.string(), extension));
}

}  // namespace

DesignFile read_design(const std::filesystem::path& path) {
  DesignFile design = read_unchecked(path);
  for (NurbsSurface& surface : design.surfaces) {
    const std::vector<std::string> notes = check_surface(surface, path.string());
    design.warnings.insert(design.warnings.end(), notes.begin(), notes.end());
  }
  return design;
}

}  // namespace bladefit
