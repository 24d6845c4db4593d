#include "tools/design/read_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "tools/design/cad_library.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Kinds of files that are not read, and the way on.
struct OtherKind {
  std::string_view extension;
  const char* way;
};
constexpr const char* kFromCad = "export the blade from the CAD system as STEP (AP214 or AP242) or IGES";
constexpr const char* kFromMesh = "a mesh has no surface to judge by: export the CAD model as STEP or IGES";
constexpr const char* kUnpack = "unpack it (gunzip -c FILE > design.stp) and give that";
constexpr std::array<OtherKind, 18> kOtherKinds = {
    {{".jt", kFromCad},
     {".x_t", kFromCad},
     {".x_b", kFromCad},
     {".xmt_txt", kFromCad},
     {".3dm", kFromCad},
     {".sldprt", kFromCad},
     {".prt", kFromCad},
     {".ipt", kFromCad},
     {".catpart", kFromCad},
     {".sat", kFromCad},
     {".stl", kFromMesh},
     {".obj", kFromMesh},
     {".ply", kFromMesh},
     {".3mf", kFromMesh},
     {".gz", kUnpack},
     {".stpz", kUnpack},
     {".zip", "unpack it and give the STEP or IGES file in it"},
     {".stpx", "STEP in XML is not read: export the blade as STEP (.stp)"}}};

DesignFile read_unchecked(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".igs" || extension == ".iges") return cad_library().read_iges(path);
  if (extension == ".stp" || extension == ".step" || extension == ".p21") return cad_library().read_step(path);
  const auto other = std::ranges::find(kOtherKinds, extension, &OtherKind::extension);
  throw ToolError(
      fmt::format("{}: {} \"{}\"; {}", path.string(),
                  other == kOtherKinds.end() ? "unknown kind of design" : "cannot read designs of kind", extension,
                  other == kOtherKinds.end() ? "give a file named .igs, .iges, .stp, .step or .p21" : other->way));
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
