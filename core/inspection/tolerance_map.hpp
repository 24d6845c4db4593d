#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "core/inspection/shaft_axis.hpp"
#include "core/inspection/tolerance_zone.hpp"

namespace bladefit {

/// Part of a patch between isoparameter lines, limits included.
struct ParameterBox {
  std::uint32_t patch = 0;
  double u_min = 0, u_max = 1, v_min = 0, v_max = 1;
  std::uint32_t zone = 0;  ///< boxes of the same number, which stand together, are one zone; 0: the box is one by
                           ///< itself. In a map with zones: of the one that it belongs to, from 1
};

/// Tolerance as a function over the patch parameters (thesis 4-6, 4-7, footnote 4), or zones with tolerances of their
/// own. Where there are zones, a place has the tolerances of the first one that it lies in, outside of all the rest's,
/// and what is said of the leading edge and of a transition plays no part.
struct ToleranceMap {
  static constexpr std::size_t kMaxBoxes = 128;
  static constexpr std::size_t kMaxZones = 16;
  std::array<ParameterBox, kMaxBoxes> boxes{};  ///< the leading-edge region is their union
  std::uint32_t box_count = 0;
  double leading_edge_mm = std::numeric_limits<double>::infinity();  ///< |d| allowed inside; infinity = not judged
  double rest_mm = std::numeric_limits<double>::infinity();          ///< |d| allowed on the rest
  double transition = 0;           ///< width, in parameter units, over which the tolerance rises linearly outside a box
  std::uint32_t least_points = 1;  ///< judged points that every zone needs, or the blade is not decided
  std::array<ToleranceZone, kMaxZones> zones{};  ///< by falling precedence
  std::uint32_t zone_count = 0;
  ShaftAxis axis{};  ///< about which the radii of zones are
};

/// What a place of the design belongs to.
struct MapPart {
  Region region = Region::rest;
  std::uint8_t zone = 0;  ///< from 1; 0: none of them, the rest
};

/// Whether (u, v) of `patch` lies in the box.
[[nodiscard]] inline bool contains(const ParameterBox& box, std::uint32_t patch, double u, double v) {
  return box.patch == patch && u >= box.u_min && u <= box.u_max && v >= box.v_min && v <= box.v_max;
}

/// The first box of the zone that box `k` belongs to. Cost: linear in the boxes of the zone.
[[nodiscard]] std::uint32_t first_of_zone(const ToleranceMap& map, std::uint32_t k);

/// Whether any distance is judged.
[[nodiscard]] bool sets_tolerance(const ToleranceMap& map);

/// Whether every distance is judged, wherever its foot lies.
[[nodiscard]] bool judges_everywhere(const ToleranceMap& map);

/// The smallest tolerance of a region [mm], on either side; infinity: none is set. Cost: linear in zone_count.
[[nodiscard]] double tightest_of(const ToleranceMap& map, Region region);

/// Region of a foot at (u, v) of `patch`, in a map without zones. Cost: linear in box_count.
[[nodiscard]] inline Region region_at(const ToleranceMap& map, std::uint32_t patch, double u, double v) {
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    if (contains(map.boxes[k], patch, u, v)) return Region::leading_edge;
  }
  return Region::rest;
}

/// What a foot at (u, v) of `patch`, which is `point` [design coordinates], belongs to. Cost: linear in box_count and
/// zone_count.
[[nodiscard]] MapPart part_at(const ToleranceMap& map, std::uint32_t patch, double u, double v, const Vec3& point);

/// Tolerance [mm] at (u, v) of `patch`, which lies in `region` and in no zone; the transition included. Cost: linear in
/// box_count.
[[nodiscard]] double tolerance_at(const ToleranceMap& map, Region region, std::uint32_t patch, double u, double v);
[[nodiscard]] inline double tolerance_at(const ToleranceMap& map, std::uint32_t patch, double u, double v) {
  return tolerance_at(map, region_at(map, patch, u, v), patch, u, v);
}

}  // namespace bladefit
