#include "tools/design/step/step_reader.hpp"

#include <fmt/format.h>
#include <Interface_Check.hxx>
#include <STEPControl_Reader.hxx>
#include <StepGeom_BSplineSurface.hxx>
#include <StepGeom_RectangularTrimmedSurface.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationRelationshipWithTransformation.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "tools/design/occ/cad_session.hpp"
#include "tools/design/occ/face_trim.hpp"
#include "tools/design/step/step_surface.hpp"
#include "tools/design/step/step_text.hpp"
#include "tools/design/step/step_unit.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kPatchName = "PATCH";

/// A B-spline surface entity with the name of its face.
struct NamedSurface {
  int number = 0;  ///< of the entity in the file: #number
  std::string face;
  Handle(StepGeom_BSplineSurface) entity;
};

/// k of a face named PATCHk.
std::optional<int> patch_number(const std::string& face) {
  if (face.compare(0, kPatchName.size(), kPatchName) != 0) return std::nullopt;
  int number = 0;
  const char* end = face.data() + face.size();
  const auto [stop, error] = std::from_chars(face.data() + kPatchName.size(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// An entity that the library could not read is no error by itself, unless a surface depends on it.
void check_readable(const StepData_StepModel& model, int index, const std::string& file) {
  if (!model.IsErrorEntity(index)) return;
  const Handle(Interface_Check)& check = model.Check(index, Standard_True);
  const std::string reason = !check.IsNull() && check->NbFails() > 0 ? check->CFail(1) : "damaged record";
  throw ToolError(fmt::format("{}: #{} ({}): {}; export the design again", file, model.IdentLabel(model.Value(index)),
                              model.TypeName(model.Value(index), Standard_False), reason));
}

/// Refuses what would stand somewhere else than its coordinates say.
void check_placement(const StepData_StepModel& model, int index, const std::string& file) {
  const Handle(Standard_Transient)& entity = model.Value(index);
  if (entity->IsKind(STANDARD_TYPE(StepRepr_MappedItem)) ||
      entity->IsKind(STANDARD_TYPE(StepRepr_RepresentationRelationshipWithTransformation))) {
    throw ToolError(
        fmt::format("{}: #{}: the file is an assembly, whose placements are not supported; export the "
                    "blade as one part",
                    file, model.IdentLabel(entity)));
  }
}

std::string list_types(const StepData_StepModel& model) {
  std::map<std::string, int> counts;
  for (int k = 1; k <= model.NbEntities(); ++k) {
    ++counts[StepData_StepModel::ClassName(model.TypeName(model.Value(k), Standard_False))];
  }
  std::string list;
  for (const auto& [type, count] : counts) list += fmt::format("{}{} x {}", list.empty() ? "" : ", ", count, type);
  return list.empty() ? "none" : list;
}

std::vector<NamedSurface> find_surfaces(const StepData_StepModel& model, const std::string& file) {
  std::vector<NamedSurface> surfaces;
  std::map<const Standard_Transient*, std::string> faces;
  for (int k = 1; k <= model.NbEntities(); ++k) {
    check_readable(model, k, file);
    check_placement(model, k, file);
    const Handle(Standard_Transient)& entity = model.Value(k);
    if (const auto surface = Handle(StepGeom_BSplineSurface)::DownCast(entity); !surface.IsNull()) {
      surfaces.push_back({model.IdentLabel(entity), "", surface});
    }
    const auto face = Handle(StepShape_FaceSurface)::DownCast(entity);
    if (!face.IsNull() && !face->FaceGeometry().IsNull() && !face->Name().IsNull()) {
      faces[face->FaceGeometry().get()] = face->Name()->ToCString();
    }
  }
  for (NamedSurface& surface : surfaces) surface.face = faces[surface.entity.get()];
  return surfaces;
}

bool lies_on_a_bspline(const StepShape_FaceSurface& face) {
  Handle(StepGeom_Surface) surface = face.FaceGeometry();
  if (const auto part = Handle(StepGeom_RectangularTrimmedSurface)::DownCast(surface); !part.IsNull()) {
    surface = part->BasisSurface();
  }
  return !surface.IsNull() && surface->IsKind(STANDARD_TYPE(StepGeom_BSplineSurface));
}

/// Names of the faces that are bounded inside their B-spline surface.
std::vector<std::string> find_trimmed(STEPControl_Reader& reader) {
  const Handle(StepData_StepModel) model = reader.StepModel();
  std::vector<std::string> names;
  for (int k = 1; k <= model->NbEntities(); ++k) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(k));
    if (face.IsNull() || !lies_on_a_bspline(*face)) continue;
    reader.ClearShapes();
    reader.TransferEntity(face);
    if (!is_trimmed(reader.OneShape())) continue;
    const std::string label = face->Name().IsNull() ? "" : face->Name()->ToCString();
    names.push_back(
        fmt::format("face #{}{}", model->IdentLabel(face), label.empty() ? "" : fmt::format(" ({})", label)));
  }
  return names;
}

/// By the number of the face where all are named PATCHk; else by that of the entity.
void sort_surfaces(std::vector<NamedSurface>& surfaces) {
  const bool named = std::all_of(surfaces.begin(), surfaces.end(),
                                 [](const NamedSurface& surface) { return patch_number(surface.face).has_value(); });
  if (!named) return;
  std::stable_sort(surfaces.begin(), surfaces.end(), [](const NamedSurface& a, const NamedSurface& b) {
    return *patch_number(a.face) < *patch_number(b.face);
  });
}

DesignFile read_model(const std::string& file) {
  STEPControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    throw ToolError(fmt::format("{}: the STEP file cannot be parsed; export the design again", file));
  }
  const Handle(StepData_StepModel) model = reader.StepModel();
  std::vector<NamedSurface> surfaces = find_surfaces(*model, file);
  if (surfaces.empty()) {
    throw ToolError(
        fmt::format("{}: no B-spline surface in the file; entity types there: {}; export the blade as "
                    "B-spline surfaces",
                    file, list_types(*model)));
  }
  sort_surfaces(surfaces);
  const LengthUnit unit = read_step_unit(*model, file);
  DesignFile design;
  design.unit = shown_unit(unit);
  if (const std::string note = shown_unit_note(unit); !note.empty()) design.warnings.push_back(note);
  for (const NamedSurface& surface : surfaces) {
    const std::string name =
        fmt::format("surface #{}{}", surface.number, surface.face.empty() ? "" : fmt::format(" ({})", surface.face));
    design.surfaces.push_back(read_step_surface(surface.entity, name, unit.mm, file));
  }
  design.trimmed = find_trimmed(reader);
  return design;
}

}  // namespace

DesignFile read_step(const std::filesystem::path& path) {
  const std::string file = path.string();
  check_step_text(read_text(path), file);
  return with_cad_library(file, [&] { return read_model(file); });
}

}  // namespace bladefit
