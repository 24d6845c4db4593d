#include "tools/design/iges/iges_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tools/design/iges/iges_global.hpp"
#include "tools/design/iges/iges_surface.hpp"
#include "tools/design/iges/iges_text.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/occ/face_trim.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// A matrix may have a matrix of its own; more than this are a circle.
constexpr int kMaxMatrices = 8;
/// How far the columns of a matrix may be from orthonormal, as printed numbers are, without a warning.
constexpr double kOrthonormal = 1e-6;

/// Entities that place copies of others, and entities that bound a surface.
constexpr int kInstanceTypes[] = {408, 412, 414, 430};
constexpr int kBoundedTypes[] = {143, 144, 510};

std::string list_types(const std::map<int, int>& counts) {
  std::string list;
  for (const auto& [type, count] : counts) list += fmt::format("{}{} x {}", list.empty() ? "" : ", ", count, type);
  return list.empty() ? "none" : list;
}

/// Refuses what would stand somewhere else than its coordinates say, and tells what is used otherwise than drawn.
void check_types(const IgesText& text, DesignFile& design, const std::string& file) {
  std::map<int, int> counts;
  for (const IgesEntity& entity : text.entities) ++counts[entity.type];
  if (counts.count(kIgesSurfaceType) == 0) {
    throw ToolError(
        fmt::format("{}: no B-spline surface (entity 128) in the file; entity types there: {}; export the "
                    "blade as B-spline surfaces",
                    file, list_types(counts)));
  }
  for (const int type : kInstanceTypes) {
    if (counts.count(type) == 0) continue;
    throw ToolError(
        fmt::format("{}: entity {} places copies of other entities, which is not supported; export the "
                    "blade alone, without instances",
                    file, type));
  }
  const auto occurs = [&counts](int type) { return counts.count(type) > 0; };
  if (std::ranges::any_of(kBoundedTypes, occurs)) {
    design.trimmed = with_cad_library(file, [&file] { return trimmed_iges_faces(file); });
  }
}

/// The motion of `entity`: its matrix, then that of the matrix, and so on.
Eigen::Affine3d read_motion(const IgesText& text, const IgesEntity& entity, const IgesDelimiters& delimiters,
                            DesignFile& design, const std::string& file) {
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  int number = entity.matrix;
  for (int count = 0; number != 0; ++count) {
    const std::size_t place = static_cast<std::size_t>(number) / 2;
    const bool exists = number > 0 && number % 2 == 1 && place < text.entities.size();
    if (!exists || text.entities[place].type != kIgesMatrixType || count == kMaxMatrices) {
      throw ToolError(
          fmt::format("{}: entity 128 at D{}: its transformation matrix D{} is not an entity 124; export "
                      "the design again",
                      file, entity.directory_number, number));
    }
    const Eigen::Affine3d matrix = read_iges_matrix(IgesParameters(text.entities[place], delimiters, file));
    const Eigen::Matrix3d product = matrix.linear() * matrix.linear().transpose();
    if ((product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kOrthonormal) {
      design.warnings.push_back(fmt::format("the matrix at D{} is not a rotation; it is used as it stands", number));
    }
    motion = matrix * motion;
    number = text.entities[place].matrix;
  }
  return motion;
}

NurbsSurface read_surface(const IgesText& text, const IgesEntity& entity, const IgesGlobal& global, DesignFile& design,
                          const std::string& file) {
  NurbsSurface surface = read_iges_surface(IgesParameters(entity, global.delimiters, file));
  surface.name = fmt::format("entity 128 at D{}", entity.directory_number);
  if (!entity.label.empty()) surface.name += fmt::format(" ({})", entity.label);
  if (entity.matrix != 0) {
    const Eigen::Affine3d motion = read_motion(text, entity, global.delimiters, design, file);
    for (Eigen::Vector3d& point : surface.control_points) point = motion * point;
  }
  const double mm = global.unit.mm / global.model_scale;
  for (Eigen::Vector3d& point : surface.control_points) point *= mm;
  return surface;
}

}  // namespace

DesignFile read_iges(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string content = read_text(path);
  const IgesText text = split_iges_text(content, file);
  const IgesGlobal global = read_iges_global(text.global, file);
  DesignFile design;
  design.unit = shown_unit(global.unit);
  design.warnings = global.warnings;
  check_types(text, design, file);
  for (const IgesEntity& entity : text.entities) {
    if (entity.type != kIgesSurfaceType) continue;
    design.surfaces.push_back(read_surface(text, entity, global, design, file));
  }
  return design;
}

}  // namespace bladefit
