#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "firmware_bridge/host/blade/blade_view.hpp"

namespace bladefit {

/// A place on the cylinder about the shaft axis at some radius, unrolled: along the axis, and the angle about it times
/// the radius [mm].
using UnrolledPlace = Eigen::Vector2d;

/// A section of the design by a cylinder about the shaft axis: a place of the two ends of its longest chord.
struct BladeStation {
  double radius = 0;                              ///< [mm]
  double leading_along = 0, leading_angle = 0;    ///< leading edge: along the axis [mm], about it [rad]
  double trailing_along = 0, trailing_angle = 0;  ///< trailing edge
};

/// A piece of a section's curve.
struct SectionPiece {
  UnrolledPlace from = UnrolledPlace::Zero(), to = UnrolledPlace::Zero();
  bool leading_edge = false;  ///< within the leading-edge region
};

/// A section near which points were measured.
struct MeasuredSection {
  double radius = 0;  ///< [mm]
  std::vector<SectionPiece> pieces;
};

/// Where the foot of a point lies on the blade.
struct PlacedPoint {
  double radius = 0, along = 0, angle = 0;                  ///< about and along the shaft axis [mm, rad]
  double chord = std::numeric_limits<double>::quiet_NaN();  ///< 0 leading edge, 1 trailing edge; NaN = not known
  UnrolledPlace normal = UnrolledPlace::Zero();             ///< outward normal of the section there, unit
  BladeSide side = BladeSide::unknown;
  BladeSide face = BladeSide::unknown;  ///< the same with the nose shared out between suction and pressure
  std::uint16_t section = 0;            ///< of the nearest measured section
};

/// What pictures and tables of a report need to know of the design. The leading edge and the sides are known where a
/// leading-edge region is set.
struct BladeDrawing {
  double root_radius = 0, tip_radius = 0;  ///< of the surface [mm]
  bool edge_known = false, sides_known = false;
  double suction_ahead = 1;               ///< +1: the suction side looks along the axis' direction, -1 against it
  double suction_beside = 1;              ///< +1: it lies on the positive side of the chord, as on_chord() counts
  std::vector<BladeStation> stations;     ///< rising radius; none where the design is not cut by cylinders
  std::vector<MeasuredSection> sections;  ///< rising radius
  std::vector<PlacedPoint> points;        ///< of the result's points, in their order
  std::vector<BladeDefect> defects;       ///< the worst first
  std::uint32_t out_not_joined = 0;       ///< points out beyond the number that is joined to defects
};

}  // namespace bladefit
