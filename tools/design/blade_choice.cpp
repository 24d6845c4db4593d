#include "tools/design/blade_choice.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "tools/design/blades/design_blades.hpp"
#include "tools/design/blades/face_groups.hpp"
#include "tools/design/face_choice.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// "x", "y", "z", or the direction; with the point where it does not go through the origin.
std::string axis_text(const ShaftAxis& axis, DesignUnit unit) {
  std::string text = fmt::format("{:.4g}, {:.4g}, {:.4g}", axis.direction.x(), axis.direction.y(), axis.direction.z());
  for (int k = 0; k < 3; ++k) {
    if (axis.direction == Eigen::Vector3d::Unit(k)) text = std::string(1, "xyz"[k]);
  }
  if (axis.point.isZero()) return text;
  const Eigen::Vector3d point = axis.point / mm_per_unit(unit);
  return fmt::format("{} through {:.4g}, {:.4g}, {:.4g} {}", text, point.x(), point.y(), point.z(), unit_name(unit));
}

/// "0 to 3, 7".
std::string face_numbers(const std::vector<std::size_t>& faces) {
  std::string text;
  for (std::size_t k = 0; k < faces.size();) {
    std::size_t last = k;
    while (last + 1 < faces.size() && faces[last + 1] == faces[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", faces[k]);
    if (last > k) text += fmt::format("{}{}", last > k + 1 ? " to " : ", ", faces[last]);
    k = last + 1;
  }
  return text;
}

/// "4 blades about x, numbered as the right hand turns about it, from that nearest to +y".
std::string blades_title(const DesignBlades& found, DesignUnit unit) {
  const char* from = across(found.axis).z() > 0.5 ? "+z" : "+y";
  return fmt::format("{} blades about {}, numbered as the right hand turns about it, from that nearest to {}",
                     found.blades.size(), axis_text(found.axis, unit), from);
}

double degrees_of(const DesignBlade& blade) { return blade.angle * 180 / std::numbers::pi; }

}  // namespace

std::size_t blade_number(double given) {
  if (given != std::floor(given)) throw ToolError(fmt::format("--blade {:g}: is not a whole number", given));
  return static_cast<std::size_t>(given);
}

void keep_blade(DesignFile& design, std::size_t number, const std::optional<ShaftAxis>& axis, const std::string& file) {
  const DesignBlades found = find_blades(design.surfaces, axis);
  if (found.blades.empty()) {
    throw ToolError(
        fmt::format("{}: --blade {}: no blades that repeat about {} can be told apart; choose the faces of one with "
                    "--face (`bladefit compile FILE --list` shows them){}",
                    file, number, axis ? axis_text(*axis, design.unit) : "x, y or z",
                    axis ? ", or correct --axis" : ", or give the shaft with --axis"));
  }
  if (number < 1 || number > found.blades.size()) {
    throw ToolError(fmt::format("{}: --blade {}: the design has {}; `bladefit compile FILE --list` shows them", file,
                                number, blades_title(found, design.unit)));
  }
  const DesignBlade& blade = found.blades[number - 1];
  design.warnings.push_back(fmt::format(
      "blade {} of {}, {:.0f} degrees from there: faces {}; left out: the other blades, {} faces of the hub, {} others",
      number, blades_title(found, design.unit), degrees_of(blade), face_numbers(blade.faces), found.hub.size(),
      found.others.size()));
  keep_numbers(design, blade.faces);
}

std::vector<std::string> blade_lines(const DesignFile& design) {
  const DesignBlades found = find_blades(design.surfaces, std::nullopt);
  if (found.blades.empty()) return {};
  std::vector<std::string> lines = {blades_title(found, design.unit) + ":"};
  for (std::size_t k = 0; k < found.blades.size(); ++k) {
    lines.push_back(fmt::format("  --blade {}: {:.0f} degrees, faces {}", k + 1, degrees_of(found.blades[k]),
                                face_numbers(found.blades[k].faces)));
  }
  if (!found.hub.empty()) lines.push_back(fmt::format("  hub: faces {}", face_numbers(found.hub)));
  if (!found.others.empty()) lines.push_back(fmt::format("  of neither: faces {}", face_numbers(found.others)));
  return lines;
}

}  // namespace bladefit
