#pragma once
#include <cstdint>

#include "core/algebra/matrix.hpp"

namespace bladefit {

enum class FootKind : std::uint8_t { interior = 0, edge = 1, corner = 2 };

/// What the edge or corner is of that a foot lies on.
enum class FootBorder : std::uint8_t {
  none = 0,       ///< of nothing: the foot is interior
  joint = 1,      ///< patches that meet, or a crease of one: material goes on beyond it
  outer = 2,      ///< the design: there is no surface beyond it
  joint_end = 3,  ///< corner: the design ends one way, patches meet the other way
};

/// The point of the design nearest to a measured point, in design coordinates [mm].
struct Foot {
  std::uint32_t patch = 0;
  double u = 0, v = 0;         ///< normalised parameters, 0..1
  Vec3 point = Vec3::Zero();   ///< q on the surface
  Vec3 normal = Vec3::Zero();  ///< outward unit normal; at an edge or corner foot the unit vector of r - q, or of q - r
                               ///< where r lies inside of the material at a joint
  double distance = 0;         ///< oriented distance, less the probe radius: > 0 excess material
  FootKind kind = FootKind::interior;
  FootBorder border = FootBorder::none;
  double beyond = 0;  ///< how far r lies beyond the outer edge along the surface, less the probe radius's share; 0: it
                      ///< does not, or there is none
};

}  // namespace bladefit
