#pragma once
#include <array>
#include <cstdint>
#include <limits>

namespace bladefit {

enum class Region : std::uint8_t { rest = 0, leading_edge = 1 };

/// Part of a patch between isoparameter lines, limits included.
struct ParameterBox {
  std::uint32_t patch = 0;
  double u_min = 0, u_max = 1, v_min = 0, v_max = 1;
  std::uint32_t zone =
      0;  ///< boxes of the same number, which stand together, are one zone; 0: the box is one by itself
};

/// Tolerance as a function over the patch parameters (thesis 4-6, 4-7, footnote 4).
struct ToleranceMap {
  static constexpr std::size_t kMaxBoxes = 128;
  std::array<ParameterBox, kMaxBoxes> boxes{};  ///< the leading-edge region is their union
  std::uint32_t box_count = 0;
  double leading_edge_mm = std::numeric_limits<double>::infinity();  ///< |d| allowed inside; infinity = not judged
  double rest_mm = std::numeric_limits<double>::infinity();          ///< |d| allowed on the rest
  double transition = 0;           ///< width, in parameter units, over which the tolerance rises linearly outside a box
  std::uint32_t least_points = 1;  ///< judged points that every zone needs, or the blade is not decided
};

/// Whether (u, v) of `patch` lies in the box.
[[nodiscard]] inline bool contains(const ParameterBox& box, std::uint32_t patch, double u, double v) {
  return box.patch == patch && u >= box.u_min && u <= box.u_max && v >= box.v_min && v <= box.v_max;
}

/// The first box of the zone that box `k` belongs to. Cost: linear in the boxes of the zone.
[[nodiscard]] std::uint32_t first_of_zone(const ToleranceMap& map, std::uint32_t k);

/// Whether any distance is judged.
[[nodiscard]] bool sets_tolerance(const ToleranceMap& map);

/// Region of a foot at (u, v) of `patch`. Cost: linear in box_count.
[[nodiscard]] inline Region region_at(const ToleranceMap& map, std::uint32_t patch, double u, double v) {
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    if (contains(map.boxes[k], patch, u, v)) return Region::leading_edge;
  }
  return Region::rest;
}

/// Tolerance [mm] at (u, v) of `patch`, which lies in `region`; the transition zone included. Cost: linear in
/// box_count.
[[nodiscard]] double tolerance_at(const ToleranceMap& map, Region region, std::uint32_t patch, double u, double v);
[[nodiscard]] inline double tolerance_at(const ToleranceMap& map, std::uint32_t patch, double u, double v) {
  return tolerance_at(map, region_at(map, patch, u, v), patch, u, v);
}

}  // namespace bladefit
