#pragma once
#include <string>
#include <vector>

#include "core/inspection/tolerance_map.hpp"
#include "tools/show/page_lines.hpp"

namespace bladefit {

/// A measured point, as it stands, and the place of the design nearest to it.
struct PagePoint {
  std::size_t number = 0;  ///< counted from 0, as in result.json
  Vec3 place = Vec3::Zero();
  std::uint32_t patch = 0;
  double u = 0, v = 0;
  double distance = 0;     ///< oriented [mm], less the probe radius
  bool in_zone = false;    ///< of the leading edge, or any of the named ones
  std::uint32_t zone = 0;  ///< of those, from 1; 0: none
};

/// All that a page shows; lengths in mm.
struct PageContent {
  std::string title;
  std::string units = "mm";  ///< in which lengths are shown
  double mm_per_unit = 1;
  ShaftAxis axis;
  double tip_radius_mm = 0;
  std::vector<std::string> names;       ///< of the faces, one a patch; may be empty texts
  std::vector<FaceMesh> faces;          ///< one a patch
  std::vector<FaceMesh> zones;          ///< parts of the leading edge, or of the named zones
  std::vector<std::string> zone_names;  ///< of zones with tolerances of their own
  std::vector<PageLine> lines;
  std::vector<PagePoint> points;
  std::vector<std::string> notes;  ///< one line each
};

/// Faces, iso-lines, rings, ridges and zones of a design; `content` has title, units, axis and radius already.
void fill_page(const Surface& surface, const ToleranceMap& tolerance, PageContent& content);

}  // namespace bladefit
