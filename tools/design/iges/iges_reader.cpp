#include "tools/design/iges/iges_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>

#include <algorithm>
#include <array>
#include <map>

#include "tools/design/iges/iges_clean.hpp"
#include "tools/design/iges/iges_references.hpp"
#include "tools/design/iges/iges_solid_places.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/occ/design_faces.hpp"
#include "tools/design/occ/memory_file.hpp"
#include "tools/design/occ/transferred_faces.hpp"
#include "tools/design/text/design_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Surfaces, bounded surfaces and faces.
constexpr std::array<int, 16> kSurfaceTypes = {108, 114, 118, 120, 122, 128, 140, 143,
                                               144, 190, 192, 194, 196, 198, 510, 182};
/// What the status digits of an entity say.
constexpr int kPhysicallyDependent = 1, kBothDependent = 3, kGeometry = 0, kDefinition = 2, kLogical = 4;
constexpr int kNameProperty = 406, kNameForm = 15;

bool is_surface(int type) { return std::ranges::find(kSurfaceTypes, type) != kSurfaceTypes.end(); }

/// Solids made of faces, what holds surfaces and solids, and solids of other kinds, which the library does not know.
constexpr int kSolidOfFaces = 186;
constexpr std::array<int, 3> kHolderTypes = {184, 408, 430};
constexpr std::array<int, 10> kPrimitiveTypes = {150, 152, 154, 156, 158, 160, 162, 164, 168, 180};

/// A face of the design should come of it.
bool holds_faces(const CleanIges& iges, std::size_t index) {
  const int type = iges.entities[index].type;
  if (is_surface(type) || type == kSolidOfFaces || std::ranges::find(kPrimitiveTypes, type) != kPrimitiveTypes.end())
    return true;
  if (std::ranges::find(kHolderTypes, type) == kHolderTypes.end()) return false;
  return std::ranges::any_of(iges_parts(iges.entities, iges.parameters, index), [&](std::size_t part) {
    return is_surface(iges.entities[part].type) || iges.entities[part].type == kSolidOfFaces;
  });
}

int status_digit(const IgesEntity& entity, std::size_t pair) {
  return 10 * (entity.status[2 * pair] - '0') + (entity.status[2 * pair + 1] - '0');
}
bool is_blank(const IgesEntity& entity) { return status_digit(entity, 0) != 0; }
/// It is drawn for itself, not as a part of another entity.
bool is_independent(const IgesEntity& entity) {
  const int dependence = status_digit(entity, 1);
  return dependence != kPhysicallyDependent && dependence != kBothDependent;
}
bool is_shape(const IgesEntity& entity) {
  const int use = status_digit(entity, 2);
  return use == kGeometry || use == kDefinition || use == kLogical;
}

/// What is left out on purpose: hidden surfaces, construction geometry and annotation.
bool is_left_out(const IgesEntity& entity) { return is_independent(entity) && (is_blank(entity) || !is_shape(entity)); }

/// The entity to which a parameter refers; nothing where it is no reference.
const IgesEntity* target_of(const CleanIges& iges, const IgesParameters& parameters, std::size_t place) {
  const std::optional<double> number = parse_iges_real(parameters.text(place));
  if (!number || !(*number >= 1) || *number > 2.0 * static_cast<double>(iges.entities.size())) return nullptr;
  return &iges.entities[static_cast<std::size_t>(*number) / 2];
}

/// The name that a property (entity 406, form 15) gives; properties stand at the end of the parameters.
std::string property_name(const CleanIges& iges, const IgesParameters& parameters) {
  for (std::size_t place = parameters.size(); place-- > 1;) {
    const IgesEntity* property = target_of(iges, parameters, place);
    if (property == nullptr || property->type != kNameProperty) return {};
    const auto index = static_cast<std::size_t>(property - iges.entities.data());
    if (property->form == kNameForm) return iges.parameters[index].string(2).value_or("");
  }
  return {};
}

/// Its own name or label, else that of the surface that it bounds.
std::string name_of(const CleanIges& iges, std::size_t index) {
  const IgesEntity& entity = iges.entities[index];
  std::string name = property_name(iges, iges.parameters[index]);
  if (name.empty()) name = entity.label;
  if (!name.empty() || entity.type == 128 || !is_surface(entity.type) || iges.parameters[index].size() < 3) return name;
  const IgesEntity* surface = target_of(iges, iges.parameters[index], entity.type == 143 ? 2 : 1);
  if (surface == nullptr || !is_surface(surface->type)) return {};
  return name_of(iges, static_cast<std::size_t>(surface - iges.entities.data()));
}

std::string list_types(const CleanIges& iges) {
  std::map<int, int> counts;
  for (const IgesEntity& entity : iges.entities) ++counts[entity.type];
  std::vector<std::string> list;
  list.reserve(counts.size());
  for (const auto& [type, count] : counts) list.push_back(fmt::format("{} x {}", count, type));
  return list.empty() ? "none" : fmt::format("{}", fmt::join(list, ", ")).substr(0, 120);
}

/// Names the faces by their entities, leaves out hidden ones, and moves those of solids to their place.
void name_faces(const CleanIges& iges, const IgesSolidPlaces& places, const IGESData_IGESModel& model,
                const FaceSources& sources, CadFaces& read) {
  std::vector<CadFace> shown;
  for (CadFace& face : read.faces) {
    const auto source = sources.find(key_of(face.face));
    const auto entity = Handle(IGESData_IGESEntity)::DownCast(source == sources.end() ? nullptr : source->second);
    if (entity.IsNull()) {
      face.entity = "face";
      face.order = std::numeric_limits<int>::max();
    } else {
      face.order = model.DNum(entity);
      const auto index = static_cast<std::size_t>(face.order) / 2;
      if (is_left_out(iges.entities[index])) continue;
      face.entity = fmt::format("entity {} at D{}", entity->TypeNumber(), face.order);
      places.place(index, face);
      face.name = name_of(iges, index);
      face.layer = iges.entities[index].level > 0 ? fmt::format("{}", iges.entities[index].level) : "";
    }
    shown.push_back(std::move(face));
  }
  read.faces = std::move(shown);
  std::ranges::stable_sort(read.faces, {}, &CadFace::order);
}

/// Surfaces of the file of which the transfer made nothing, and what was left out.
void note_absent(const CleanIges& iges, IGESControl_Reader& reader, CadFaces& read) {
  std::size_t left_out = 0;
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (std::size_t k = 0; k < iges.entities.size(); ++k) {
    const IgesEntity& entity = iges.entities[k];
    if (!is_independent(entity) || !holds_faces(iges, k)) continue;
    if (is_left_out(entity)) {
      ++left_out;
      continue;
    }
    const Handle(IGESData_IGESEntity) source = reader.IGESModel()->Entity(static_cast<int>(k + 1));
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, source);
    if (!shape.IsNull() && TopExp_Explorer(shape, TopAbs_FACE).More()) continue;
    const std::string name = name_of(iges, k);
    read.unread.push_back(fmt::format("entity {} at D{}{}: the CAD library makes no face of it", entity.type, 2 * k + 1,
                                      name.empty() ? "" : fmt::format(" ({})", name)));
  }
  if (left_out > 0) {
    read.notes.push_back(fmt::format("{} hidden or construction surfaces or bodies are left out", left_out));
  }
}

CadFaces read_faces(const CleanIges& iges, const std::string& file) {
  const MemoryFile copy(iges.text);
  IGESControl_Reader reader;
  Interface_Static::SetIVal("read.iges.bspline.continuity", 0);  // a crease is no reason to cut a surface
  reader.SetReadVisible(true);
  if (reader.ReadFile(copy.path().c_str()) != IFSelect_RetDone) {
    throw ToolError(fmt::format("{}: the CAD library cannot read the file; export the design again", file));
  }
  reader.TransferRoots();
  CadFaces read;
  if (const TopoDS_Shape shape = reader.OneShape(); !shape.IsNull()) read.faces = faces_of(shape);
  name_faces(iges, IgesSolidPlaces(iges, file), *reader.IGESModel(), face_sources(reader.WS()), read);
  note_absent(iges, reader, read);
  if (read.faces.empty() && read.unread.empty()) {
    throw ToolError(fmt::format(
        "{}: no visible surface in the file{}; entity types there: {}; export the blade as surfaces or as a "
        "solid, not hidden",
        file, read.notes.empty() ? "" : " (" + read.notes.front() + ")", list_types(iges)));
  }
  return read;
}

}  // namespace

DesignFile read_iges(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string content = read_design_text(path);
  const CleanIges iges = clean_iges_text(content, file);
  DesignFile design;
  design.unit = shown_unit(iges.global.unit);
  design.file_unit_mm = iges.global.unit.mm;
  design.warnings = iges.warnings;
  with_cad_library(file, [&] {
    append_surfaces(read_faces(iges, file), design);
    return 0;
  });
  const double scale = iges.global.model_scale;
  for (NurbsSurface& surface : design.surfaces) {
    for (Eigen::Vector3d& point : surface.control_points) point /= scale;
  }
  for (DesignFace& face : design.faces) face.area /= scale * scale;
  return design;
}

}  // namespace bladefit
