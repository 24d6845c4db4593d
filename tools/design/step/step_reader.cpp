#include "tools/design/step/step_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <STEPControl_Reader.hxx>
#include <StepGeom_Surface.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "tools/design/occ/cad_session.hpp"
#include "tools/design/occ/design_faces.hpp"
#include "tools/design/occ/transferred_faces.hpp"
#include "tools/design/step/step_implied_knots.hpp"
#include "tools/design/step/step_model.hpp"
#include "tools/design/step/step_operator.hpp"
#include "tools/design/step/step_places.hpp"
#include "tools/design/step/step_text.hpp"
#include "tools/design/step/step_unit.hpp"
#include "tools/design/text/design_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kPatchName = "PATCH";

/// k of a face named PATCHk.
std::optional<int> patch_number(const std::string& face) {
  if (face.compare(0, kPatchName.size(), kPatchName) != 0) return std::nullopt;
  int number = 0;
  const char* end = face.data() + face.size();
  const auto [stop, error] = std::from_chars(face.data() + kPatchName.size(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// By the number of the face where all are named PATCHk; else by that of the entity. Copies of a part stay in the order
/// of the assembly.
void sort_faces(std::vector<CadFace>& faces) {
  std::vector<std::pair<int, CadFace>> keyed;
  const bool named =
      std::ranges::all_of(faces, [](const CadFace& face) { return patch_number(face.name).has_value(); });
  for (CadFace& face : faces) {
    const int key = named ? *patch_number(face.name) : face.order;
    keyed.emplace_back(key, std::move(face));
  }
  std::ranges::stable_sort(keyed, {}, &std::pair<int, CadFace>::first);
  for (std::size_t k = 0; k < faces.size(); ++k) faces[k] = std::move(keyed[k].second);
}

std::string name_of(const StepShape_FaceSurface& face) {
  if (!face.Name().IsNull() && face.Name()->Length() > 0) return face.Name()->ToCString();
  const Handle(StepGeom_Surface) surface = face.FaceGeometry();
  return surface.IsNull() || surface->Name().IsNull() ? "" : surface->Name()->ToCString();
}

std::string list_types(const StepData_StepModel& model) {
  std::map<std::string, int> counts;
  for (int k = 1; k <= model.NbEntities(); ++k) {
    const std::string type = model.Value(k)->DynamicType()->Name();
    if (type.find("Surface") != std::string::npos || type.find("Solid") != std::string::npos) ++counts[type];
  }
  std::vector<std::string> list;
  list.reserve(counts.size());
  for (const auto& [type, count] : counts) list.push_back(fmt::format("{} x {}", count, type));
  return list.empty() ? "none" : fmt::format("{}", fmt::join(list, ", ")).substr(0, 120);
}

/// Gives the faces of a transfer the names, layers and numbers that their entities have; leaves hidden ones out.
void name_faces(const StepModel& model, const FaceSources& sources, CadFaces& read) {
  std::size_t hidden = 0;
  std::vector<CadFace> shown;
  for (CadFace& face : read.faces) {
    const auto source = sources.find(key_of(face.face));
    const Handle(Standard_Transient) entity = source == sources.end() ? nullptr : source->second;
    if (!entity.IsNull() && model.is_hidden(entity.get())) {
      ++hidden;
      continue;
    }
    face.entity = entity.IsNull() ? "face" : "face " + model.label_of(entity);
    face.order = entity.IsNull() ? std::numeric_limits<int>::max() : model.place_of(entity);
    face.layer = entity.IsNull() ? "" : model.layer_of(entity.get());
    const auto named = Handle(StepShape_FaceSurface)::DownCast(entity);
    if (!named.IsNull()) face.name = name_of(*named);
    shown.push_back(std::move(face));
  }
  read.faces = std::move(shown);
  if (hidden > 0) read.notes.push_back(fmt::format("{} hidden faces (INVISIBILITY) are left out", hidden));
}

/// Faces of the file of which the transfer made nothing: those it failed at, and those of no product.
void note_absent(const StepModel& model, const FaceSources& sources, CadFaces& read) {
  std::set<const Standard_Transient*> made;
  for (const auto& [face, entity] : sources) made.insert(entity.get());
  std::size_t loose = 0;
  for (const Handle(StepShape_FaceSurface) & face : model.faces()) {
    if (made.count(face.get()) > 0 || model.is_hidden(face.get())) continue;
    if (!model.is_in_a_shape(face.get())) {
      ++loose;
      continue;
    }
    const Handle(StepGeom_Surface) surface = face->FaceGeometry();
    read.unread.push_back(fmt::format("face {} ({}): the CAD library makes no face of it", model.label_of(face),
                                      surface.IsNull() ? "no surface" : surface->DynamicType()->Name()));
  }
  if (loose > 0) read.notes.push_back(fmt::format("{} faces that belong to no product's shape are left out", loose));
}

DesignFile read_model(std::string text, const std::string& file) {
  STEPControl_Reader reader;
  std::istringstream stream(std::move(text));
  if (reader.ReadStream(file.c_str(), stream) != IFSelect_RetDone) {
    throw ToolError(fmt::format("{}: the STEP file cannot be parsed; export the design again", file));
  }
  const Handle(StepData_StepModel) model = reader.StepModel();
  const StepModel facts(model, reader.WS()->Graph(), file);
  facts.check_faces();
  const StepPlaces places(model, file);
  for (const Handle(StepShape_FaceSurface) & face : facts.faces()) write_implied_knots(*face);
  const LengthUnit unit = read_step_unit(*model, file);
  DesignFile design;
  design.unit = shown_unit(unit);
  design.file_unit_mm = unit.mm;
  if (const std::string note = shown_unit_note(unit); !note.empty()) design.warnings.push_back(note);
  reader.TransferRoots();
  CadFaces read;
  if (const TopoDS_Shape shape = reader.OneShape(); !shape.IsNull()) read.faces = faces_of(shape);
  const FaceSources sources = face_sources(reader.WS());
  places.place(read.faces);
  name_faces(facts, sources, read);
  note_absent(facts, sources, read);
  if (read.faces.empty() && read.unread.empty()) {
    throw ToolError(
        fmt::format("{}: no face of a product in the file; surfaces there: {}; export the blade as a solid or as "
                    "surfaces, not as a mesh or curves",
                    file, list_types(*model)));
  }
  sort_faces(read.faces);
  append_surfaces(read, design);
  return design;
}

}  // namespace

DesignFile read_step(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::string text = with_plain_operators(clean_step_text(read_design_text(path), file));
  return with_cad_library(file, [&] { return read_model(std::move(text), file); });
}

}  // namespace bladefit
