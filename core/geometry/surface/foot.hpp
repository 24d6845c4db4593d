#pragma once
#include <cstdint>

#include "core/algebra/matrix.hpp"

namespace bladefit {

enum class FootKind : std::uint8_t { interior = 0, edge = 1, corner = 2 };

/// The point of the design nearest to a measured point, in design coordinates [mm].
struct Foot {
  std::uint32_t patch = 0;
  double u = 0, v = 0;         ///< normalised parameters, 0..1
  Vec3 point = Vec3::Zero();   ///< q on the surface
  Vec3 normal = Vec3::Zero();  ///< outward unit normal; at an edge or corner foot the unit vector of r - q
  double distance = 0;         ///< oriented distance, less the probe radius: > 0 excess material
  FootKind kind = FootKind::interior;
};

}  // namespace bladefit
