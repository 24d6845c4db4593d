#include "tools/design/design_doubts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tools/design/nurbs/crossings.hpp"
#include "tools/design/nurbs/neighbours.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kListedCuts = 4;
constexpr double kSmallest_mm = 10, kLargest_mm = 20000;
/// A sliver is narrower than this part of the design, in mean width.
constexpr double kSliver = 1e-5;

/// Edges of two faces that run side by side so far apart [mm] leave a gap that may not be meant.
constexpr double kClosed_mm = 0.1, kApart_mm = 0.5;

/// Faces that reach farther than this beyond each other [mm] pass through each other; so many are listed.
constexpr double kThrough_mm = 0.1;
constexpr std::size_t kListedCrossings = 4;
/// Lengths by this part of the design's size, and areas by this part, are the same.
constexpr double kSame = 1e-6;

Eigen::AlignedBox3d box_of(const NurbsSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  return box;
}

double size_of(const DesignFile& design) {
  Eigen::AlignedBox3d box;
  for (const NurbsSurface& surface : design.surfaces) box.extend(box_of(surface));
  return box.diagonal().norm();
}

std::string title(const DesignFace& face) {
  return face.name.empty() ? face.entity : fmt::format("{} ({})", face.entity, face.name);
}

/// Faces in one place: the same box around their control points and the same area.
void append_copies(const DesignFile& design, double size, std::vector<std::string>& doubts) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const NurbsSurface& surface : design.surfaces) boxes.push_back(box_of(surface));
  std::size_t copies = 0, first = 0, second = 0;
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      const bool one_place =
          (boxes[a].min() - boxes[b].min()).norm() + (boxes[a].max() - boxes[b].max()).norm() < kSame * size;
      if (!one_place || std::abs(design.faces[a].area - design.faces[b].area) > kSame * design.faces[a].area) continue;
      if (copies++ > 0) continue;
      first = a;
      second = b;
    }
  }
  if (copies == 0) return;
  doubts.push_back(
      fmt::format("{} pair{} of faces in one place, such as {} and {}: is a part in the file twice? Choose "
                  "faces with --face",
                  copies, copies == 1 ? "" : "s", title(design.faces[first]), title(design.faces[second])));
}

void append_crossings(const DesignFile& design, std::vector<std::string>& doubts) {
  const std::vector<Crossing> crossings = find_crossings(design.surfaces, kThrough_mm);
  for (std::size_t k = 0; k < std::min(crossings.size(), kListedCrossings); ++k) {
    const Crossing& found = crossings[k];
    const std::string name = title(design.faces[found.surface]);
    const std::string what = found.surface == found.other ? name + " passes through itself"
                                                          : fmt::format("{} and {} pass through each other", name,
                                                                        title(design.faces[found.other]));
    doubts.push_back(
        fmt::format("{} over {:.2g} mm about x {:.4g}, y {:.4g}, z {:.4g} mm: points there are judged by the "
                    "nearer of two surfaces",
                    what, found.extent_mm, found.place.x(), found.place.y(), found.place.z()));
  }
  if (crossings.size() > kListedCrossings) {
    doubts.push_back(
        fmt::format("{} more pairs of faces pass through each other", crossings.size() - kListedCrossings));
  }
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
    const double width = design.faces[k].area / std::max(box_of(design.surfaces[k]).diagonal().norm(), 1e-300);
    if (width >= kSliver * size) continue;
    doubts.push_back(fmt::format("{} is a sliver, {:.2g} mm wide", title(design.faces[k]), width));
  }
  for (const Neighbours& pair : find_gaps(design.surfaces, kClosed_mm, kApart_mm)) {
    doubts.push_back(fmt::format("{} and {} run side by side up to {:.2g} mm apart: points between them have no foot",
                                 title(design.faces[pair.surface]), title(design.faces[pair.other]), pair.gap_mm));
  }
  append_copies(design, size, doubts);
  append_crossings(design, doubts);
  for (const std::string& missing : design.missing) doubts.push_back("left out: " + missing);
  return doubts;
}

}  // namespace bladefit
