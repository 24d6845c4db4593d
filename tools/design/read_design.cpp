#include "tools/design/read_design.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "tools/design/cad_library.hpp"
#include "tools/design/nurbs/thin_spans.hpp"
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
constexpr std::array<OtherKind, 16> kOtherKinds = {
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
     {".zip", "unpack it and give the STEP or IGES file in it"},
     {".stpx", "STEP in XML is not read: export the blade as STEP (.stp)"}}};

/// Of the size of a surface: no place of it moves farther where thin spans are merged.
constexpr double kMovedShare = 1e-6;

/// A line where spans were merged; empty where none was.
std::string merge_spans(NurbsSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  const double tolerance = kMovedShare * box.diagonal().norm();
  const MergedSpans merged = merge_thin_spans(surface, tolerance);
  if (merged.count() == 0) return "";
  return fmt::format(
      "{}: {} hair-thin spans in u and {} in v merged with their neighbours, which moves the surface by at most {:.2g} "
      "mm",
      surface.name, merged.spans_u, merged.spans_v, merged.moved_mm);
}

DesignFile read_unchecked(const std::filesystem::path& path) {
  const std::string last = lower_extension(path), extension = last == ".gz" ? lower_extension(path.stem()) : last;
  if (extension == ".igs" || extension == ".iges") return cad_library().read_iges(path);
  if (extension == ".stp" || extension == ".step" || extension == ".p21" || extension == ".stpz")
    return cad_library().read_step(path);
  const auto other = std::ranges::find(kOtherKinds, extension, &OtherKind::extension);
  throw ToolError(fmt::format(
      "{}: {} \"{}\"; {}", path.string(),
      other == kOtherKinds.end() ? "unknown kind of design" : "cannot read designs of kind", extension,
      other == kOtherKinds.end() ? "give a file named .igs, .iges, .stp, .step, .stpz or .p21" : other->way));
}

}  // namespace

DesignFile read_design(const std::filesystem::path& path) {
  DesignFile design = read_unchecked(path);
  for (NurbsSurface& surface : design.surfaces) {
    const std::vector<std::string> notes = check_surface(surface, path.string());
    design.warnings.insert(design.warnings.end(), notes.begin(), notes.end());
    if (const std::string line = merge_spans(surface); !line.empty()) design.warnings.push_back(line);
  }
  return design;
}

}  // namespace bladefit
