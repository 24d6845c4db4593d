#include "tools/design/iges/iges_clean.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/design/iges/iges_references.hpp"
#include "tools/design/iges/iges_surface.hpp"
#include "tools/design/iges/iges_text.hpp"
#include "tools/design/nurbs/iges_writer.hpp"
#include "tools/design/nurbs/patch_split.hpp"

namespace bladefit {
namespace {

/// Geometry and structure; what lies beyond are macros, whose parameters may be anything, and finite elements.
bool is_geometry(const IgesEntity& entity) { return entity.type >= 100 && entity.type < 600 && entity.type != 306; }

/// A number with the point and the exponent letter that the library knows.
std::string plain_number(std::string text) {
  const std::size_t exponent = text.find_first_of("eEdD");
  if (exponent == std::string::npos) return text;
  text[exponent] = 'D';
  if (text.find('.') == std::string::npos) text.insert(exponent, 1, '.');
  return text;
}

/// Parameters without strings, which the shape does not depend on.
std::string plain_parameters(const IgesParameters& parameters) {
  std::string text;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    text += (k == 0 ? "" : ",") + (parameters.string(k) ? "1H_" : plain_number(parameters.text(k)));
  }
  return text;
}

bool is_cut(const SurfaceDirection& d) {
  return d.start > d.knots[static_cast<std::size_t>(d.degree)] ||
         d.end < d.knots[static_cast<std::size_t>(d.control_points)];
}

/// The surface that ends where its parameter range does, which the library takes no notice of. Parameters stay what
/// they are: boundary curves are given in them.
NurbsSurface cut_to_range(NurbsSurface surface) {
  if (!is_cut(surface.u) && !is_cut(surface.v)) return surface;
  NurbsSurface part = part_of(surface, {});
  const auto restore = [](SurfaceDirection& cut, const SurfaceDirection& whole) {
    for (double& knot : cut.knots) knot = knot == 1 ? whole.end : whole.start + knot * (whole.end - whole.start);
    cut.start = whole.start;
    cut.end = whole.end;
  };
  restore(part.u, surface.u);
  restore(part.v, surface.v);
  return part;
}

std::string surface_parameters(const IgesEntity& entity, const IgesParameters& parameters, CleanIges& clean,
                               const std::string& file) {
  std::vector<std::string> notes;
  NurbsSurface surface = read_iges_surface(parameters, notes);
  surface.name = fmt::format("entity 128 at D{}{}", entity.directory_number,
                             entity.label.empty() ? "" : fmt::format(" ({})", entity.label));
  for (const std::string& note : notes) clean.warnings.push_back(fmt::format("{}: {}", surface.name, note));
  for (const std::string& note : check_surface(surface, file, kHighestIgesDegree)) clean.warnings.push_back(note);
  return iges_surface_parameters(cut_to_range(std::move(surface)));
}

std::string clean_parameters(const IgesEntity& entity, const IgesParameters& parameters, CleanIges& clean,
                             const std::string& file) {
  if (!is_geometry(entity)) return fmt::format("{}", entity.type);
  parameters.check_words();
  if (entity.type == kIgesSurfaceType) return surface_parameters(entity, parameters, clean, file);
  return plain_parameters(parameters);
}

}  // namespace

CleanIges clean_iges_text(std::string_view text, const std::string& file) {
  CleanIges clean;
  IgesText parts = split_iges_text(text, file);
  clean.global = read_iges_global(parts.global, file);
  clean.warnings = clean.global.warnings;
  for (const IgesEntity& entity : parts.entities) {
    clean.parameters.emplace_back(entity, clean.global.delimiters, file);
  }
  check_iges_references(parts.entities, clean.parameters, file);
  IgesOutputHeader header;
  header.units = fmt::format("{},", clean.global.unit_flag);
  if (!clean.global.resolution.empty()) header.resolution = clean.global.resolution;
  std::vector<IgesOutputEntity> output;
  for (std::size_t k = 0; k < parts.entities.size(); ++k) {
    const IgesEntity& entity = parts.entities[k];
    output.push_back({entity.type, clean_parameters(entity, clean.parameters[k], clean, file), entity.matrix, "",
                      entity.form, std::max(entity.level, 0), entity.status});
  }
  clean.text = iges_file_text(header, output);
  clean.entities = std::move(parts.entities);
  return clean;
}

}  // namespace bladefit
