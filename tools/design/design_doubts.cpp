#include "tools/design/design_doubts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tools/design/nurbs/neighbours.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kListedCuts = 4;
constexpr double kSmallest_mm = 10, kLargest_mm = 20000;
/// A sliver is narrower than this part of the design, in mean width.
constexpr double kSliver = 1e-5;

/// Edges of two faces that run side by side so far apart [mm] leave a gap that may not be meant.
constexpr double kClosed_mm = 0.1, kApart_mm = 0.5;

double diagonal(const NurbsSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  return box.diagonal().norm();
}

double size_of(const DesignFile& design) {
  Eigen::AlignedBox3d box;
  for (const NurbsSurface& surface : design.surfaces) {
    for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  }
  return box.diagonal().norm();
}

std::string title(const DesignFace& face) {
  return face.name.empty() ? face.entity : fmt::format("{} ({})", face.entity, face.name);
}

}  // namespace

std::string trim_warning(const DesignFile& design, const std::string& file) {
  std::string list;
  std::size_t count = 0;
  for (const DesignFace& face : design.faces) {
    if (face.trims_fault.empty() || ++count > kListedCuts) continue;
    list += fmt::format("{}{}: {}", count == 1 ? "" : "; ", title(face), face.trims_fault);
  }
  if (count == 0) return {};
  if (count > kListedCuts) list += fmt::format(" and {} more", count - kListedCuts);
  return fmt::format(
      "{}: trimmed faces are used up to the (u, v) box of their trim, points beyond it are judged as well: {}; "
      "heal the faces in the CAD system and export them again",
      file, list);
}

std::string trim_note(const DesignFile& design) {
  std::size_t faces = 0, loops = 0;
  double off_mm = 0;
  for (std::size_t k = 0; k < design.surfaces.size(); ++k) {
    faces += design.surfaces[k].trims.empty() ? 0 : 1;
    loops += design.surfaces[k].trims.size();
    off_mm = std::max(off_mm, design.faces[k].trims_off);
  }
  if (faces == 0) return {};
  return fmt::format("{} trimmed face{} with {} loop{}, within {:.2g} mm of the curves of the file", faces,
                     faces == 1 ? "" : "s", loops, loops == 1 ? "" : "s", off_mm);
}

std::vector<std::string> design_doubts(const DesignFile& design) {
  std::vector<std::string> doubts;
  const double size = size_of(design);
  if (size < kSmallest_mm || size > kLargest_mm) {
    doubts.push_back(
        fmt::format("the design is {:.4g} mm large, which no blade is: was it exported in another unit?", size));
  }
  for (std::size_t k = 0; k < design.faces.size(); ++k) {
    const double width = design.faces[k].area / std::max(diagonal(design.surfaces[k]), 1e-300);
    if (width >= kSliver * size) continue;
    doubts.push_back(fmt::format("{} is a sliver, {:.2g} mm wide", title(design.faces[k]), width));
  }
  for (const Neighbours& pair : find_gaps(design.surfaces, kClosed_mm, kApart_mm)) {
    doubts.push_back(fmt::format("{} and {} run side by side up to {:.2g} mm apart: points between them have no foot",
                                 title(design.faces[pair.surface]), title(design.faces[pair.other]), pair.gap_mm));
  }
  for (const std::string& missing : design.missing) doubts.push_back("left out: " + missing);
  return doubts;
}

}  // namespace bladefit
