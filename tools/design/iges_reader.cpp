#include "tools/design/iges_reader.hpp"

#include <fmt/format.h>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <TCollection_HAsciiString.hxx>
#include <gp_GTrsf.hxx>

#include "tools/design/cad_session.hpp"
#include "tools/design/iges_text.hpp"

namespace bladefit {
namespace {

SurfaceDirection read_direction(const IGESGeom_BSplineSurface& entity, bool along_u) {
  SurfaceDirection direction;
  direction.degree = along_u ? entity.DegreeU() : entity.DegreeV();
  direction.control_points = along_u ? entity.NbPolesU() : entity.NbPolesV();
  const int last_knot = direction.control_points;
  for (int k = -direction.degree; k <= last_knot; ++k) {
    direction.knots.push_back(along_u ? entity.KnotU(k) : entity.KnotV(k));
  }
  return direction;
}

std::string surface_name(const IGESGeom_BSplineSurface& entity, int directory_number) {
  const std::string number = fmt::format("entity 128 at D{}", directory_number);
  const Handle(TCollection_HAsciiString) label = entity.ShortLabel();
  if (label.IsNull()) return number;
  const std::string text = label->ToCString();
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? number : fmt::format("{} ({})", number, text.substr(first));
}

NurbsSurface read_surface(const IGESGeom_BSplineSurface& entity, const IgesSurfaceRange& range, double mm) {
  NurbsSurface surface;
  surface.name = surface_name(entity, range.directory_number);
  surface.u = read_direction(entity, true);
  surface.v = read_direction(entity, false);
  // From the text: OpenCASCADE 7.6 takes V0 for U1 and U1 for V0.
  surface.u.start = range.start_u;
  surface.u.end = range.end_u;
  surface.v.start = range.start_v;
  surface.v.end = range.end_v;
  const gp_GTrsf location = entity.CompoundLocation();
  for (int i = 0; i < surface.u.control_points; ++i) {
    for (int j = 0; j < surface.v.control_points; ++j) {
      gp_XYZ point = entity.Pole(i, j).XYZ();
      if (entity.HasTransf()) location.Transforms(point);
      surface.control_points.emplace_back(mm * point.X(), mm * point.Y(), mm * point.Z());
      surface.weights.push_back(entity.Weight(i, j));
    }
  }
  return surface;
}

std::string list_types(const IgesContents& contents) {
  std::string list;
  for (const auto& [type, count] : contents.type_counts) {
    list += fmt::format("{}{} x {}", list.empty() ? "" : ", ", count, type);
  }
  return list.empty() ? "none" : list;
}

/// Refuses what would stand somewhere else than its coordinates say, and tells what is used otherwise than drawn.
void check_contents(const IgesContents& contents, DesignFile& design, const std::string& file) {
  if (contents.surfaces.empty()) {
    throw DesignError(
        fmt::format("{}: no B-spline surface (entity 128) in the file; entity types there: {}; export the "
                    "blade as B-spline surfaces",
                    file, list_types(contents)));
  }
  for (const int instance : {408, 412, 414, 430}) {
    if (contents.type_counts.count(instance) > 0) {
      throw DesignError(
          fmt::format("{}: entity {} places copies of other entities, which is not supported; export the "
                      "blade alone, without instances",
                      file, instance));
    }
  }
  for (const int trimmed : {143, 144}) {
    if (contents.type_counts.count(trimmed) > 0) {
      design.warnings.push_back(
          fmt::format("trimmed surfaces (entity {}) are used whole, as if they were not trimmed", trimmed));
    }
  }
}

DesignFile read_model(const std::string& file, const IgesContents& contents) {
  IGESControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    throw DesignError(fmt::format("{}: the IGES file cannot be parsed; export the design again", file));
  }
  const Handle(IGESData_IGESModel) model = reader.IGESModel();
  DesignFile design;
  design.unit = shown_unit(contents.global.unit);
  design.warnings = contents.global.warnings;
  const double mm = contents.global.unit.mm / contents.global.model_scale;
  check_contents(contents, design, file);
  for (const IgesSurfaceRange& range : contents.surfaces) {
    const int number = (range.directory_number + 1) / 2;
    const auto entity = number > model->NbEntities() ? Handle(IGESGeom_BSplineSurface)()
                                                     : Handle(IGESGeom_BSplineSurface)::DownCast(model->Entity(number));
    if (entity.IsNull()) {
      throw DesignError(
          fmt::format("{}: entity 128 at D{} cannot be parsed; export the design again", file, range.directory_number));
    }
    design.surfaces.push_back(read_surface(*entity, range, mm));
  }
  return design;
}

}  // namespace

DesignFile read_iges(const std::filesystem::path& path) {
  const std::string file = path.string();
  const IgesContents contents = check_iges_text(read_text(path), file);
  return with_cad_library(file, [&] { return read_model(file, contents); });
}

}  // namespace bladefit
