#include "tools/show/page_content.hpp"
#include "tools/show/zone_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bladefit {
namespace {

/// Sections on which the ridges are sought.
constexpr std::size_t kSections = 65;

/// Iso-lines at these steps, fewer where there are many patches.
double step_for(std::size_t patches) {
  if (patches == 1) return 0.1;
  if (patches <= 4) return 0.2;
  return patches <= 12 ? 0.25 : 1.0;
}

std::string ridge_note(const RidgedBlade& blade, std::size_t ridge, double mm_per_unit, const std::string& units) {
  const SectionRidge& middle = blade.middle_of(ridge);
  const Vec3 place = middle.place.point / mm_per_unit;
  const std::string bend =
      middle.radius_mm < 1e-3 ? "a crease" : fmt::format("radius {:.3g} {}", middle.radius_mm / mm_per_unit, units);
  return fmt::format(
      "ridge {}: {:.4g} {} long, in its middle patch {} u {:.4f} v {:.4f}, x {:.4g} y {:.4g} z {:.4g} {}, {}",
      ridge + 1, blade.length_of(ridge) / mm_per_unit, units, middle.place.patch, middle.place.u, middle.place.v,
      place.x(), place.y(), place.z(), units, bend);
}

void append(std::vector<PageLine>& to, std::vector<PageLine> from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void fill_page(const Surface& surface, const ToleranceMap& tolerance, PageContent& content) {
  content.faces = mesh_faces(surface);
  for (const FaceMesh& face : content.faces) {
    append(content.lines, iso_lines(surface, face, step_for(content.faces.size())));
    append(content.lines, ring_lines(face, content.axis, content.tip_radius_mm));
  }
  for (const RidgedBlade& blade : find_ridges(surface, kSections)) {
    append(content.lines, ridge_lines(blade));
    for (std::size_t k = 0; k < blade.count; ++k)
      content.notes.push_back(ridge_note(blade, k, content.mm_per_unit, content.units));
  }
  if (tolerance.zone_count > 0) {
    for (const FaceMesh& face : content.faces) {
      std::vector<FaceMesh> parts = mesh_zones(surface, face, tolerance);
      content.zones.insert(content.zones.end(), std::make_move_iterator(parts.begin()),
                           std::make_move_iterator(parts.end()));
    }
    return;
  }
  for (std::uint32_t k = 0; k < tolerance.box_count; ++k) {
    const ParameterBox& box = tolerance.boxes.at(k);
    content.zones.push_back(mesh_inside(surface, content.faces.at(box.patch), box));
  }
}

}  // namespace bladefit
