#pragma once
#include "tools/results/blade_drawing.hpp"

namespace bladefit {

/// A place by the chord of its section: how far along it from the leading edge (0) to the trailing edge (1), and how
/// far beside it [mm].
struct ChordPlace {
  double along = 0, beside = 0;
};

/// The chord of a station, unrolled: its leading edge, and the way to its trailing edge [mm].
[[nodiscard]] UnrolledPlace leading_edge_of(const BladeStation& station);
[[nodiscard]] UnrolledPlace chord_of(const BladeStation& station);

/// The place `along` the axis [mm] and at an `angle` about it [rad], by the chord of a station.
[[nodiscard]] ChordPlace on_chord(const BladeStation& station, double along, double angle);

}  // namespace bladefit
