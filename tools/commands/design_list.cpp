#include "tools/commands/design_list.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/geometry/surface/joint.hpp"
#include "tools/design/blade_choice.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/design/nurbs/neighbours.hpp"

namespace bladefit {
namespace {

Eigen::AlignedBox3d box_of(const NurbsSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  return box;
}

/// Of each face the faces beside it, with commas.
std::vector<std::string> neighbour_lists(const DesignFile& design) {
  Eigen::AlignedBox3d whole;
  for (const NurbsSurface& surface : design.surfaces) whole.extend(box_of(surface));
  std::vector<std::string> lists(design.surfaces.size());
  for (const Neighbours& pair : find_neighbours(design.surfaces, joint_gap(0.5 * whole.diagonal().norm()))) {
    lists[pair.surface] += fmt::format("{}{}", lists[pair.surface].empty() ? "" : ",", pair.other);
    lists[pair.other] += fmt::format("{}{}", lists[pair.other].empty() ? "" : ",", pair.surface);
  }
  return lists;
}

std::string row(const DesignFile& design, std::size_t k, const std::string& neighbours) {
  const DesignFace& face = design.faces[k];
  const NurbsSurface& surface = design.surfaces[k];
  const double unit = mm_per_unit(design.unit);
  const Eigen::Vector3d middle = box_of(surface).center() / unit;
  const auto or_dash = [](const std::string& text) { return text.empty() ? std::string("-") : text; };
  return fmt::format("{:>4}  {:<18}  {:<10}  {:<21}  {:<16}  {:>10.4g}  {:<28}  {:>5}  {}\n", k, or_dash(face.name),
                     or_dash(face.layer), face.kind,
                     fmt::format("{} x {}, {} x {}", surface.u.control_points, surface.v.control_points,
                                 surface.u.degree, surface.v.degree),
                     face.area / (unit * unit),
                     fmt::format("{:.1f}, {:.1f}, {:.1f}", middle.x(), middle.y(), middle.z()),
                     face.share < 0.995 ? fmt::format("{:.0f} %", 100 * (1 - face.share)) : "-", or_dash(neighbours));
}

}  // namespace

std::string design_list(const std::vector<std::filesystem::path>& paths) {
  const DesignFile design = read_designs(paths);
  const std::vector<std::string> neighbours = neighbour_lists(design);
  std::string text =
      fmt::format("{:>4}  {:<18}  {:<10}  {:<21}  {:<16}  {:>10}  {:<28}  {:>5}  {}\n", "face", "name", "layer", "kind",
                  "points, degrees", fmt::format("area {}2", unit_name(design.unit)), "middle", "trim", "beside");
  for (std::size_t k = 0; k < design.surfaces.size(); ++k) text += row(design, k, neighbours[k]);
  for (const std::string& line : blade_lines(design)) text += line + "\n";
  for (const std::string& missing : design.missing) text += fmt::format("   -  cannot be read: {}\n", missing);
  for (const std::string& warning : design.warnings) text += fmt::format("note: {}\n", warning);
  return text;
}

}  // namespace bladefit
