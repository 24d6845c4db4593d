#include "tools/drawing/chord_place.hpp"

namespace bladefit {

UnrolledPlace leading_edge_of(const BladeStation& station) {
  return {station.leading_along, station.radius * station.leading_angle};
}

UnrolledPlace chord_of(const BladeStation& station) {
  return UnrolledPlace(station.trailing_along, station.radius * station.trailing_angle) - leading_edge_of(station);
}

ChordPlace on_chord(const BladeStation& station, double along, double angle) {
  const UnrolledPlace chord = chord_of(station);
  const UnrolledPlace arm = UnrolledPlace(along, station.radius * angle) - leading_edge_of(station);
  const double length = chord.norm();
  return {arm.dot(chord) / (length * length), (chord.x() * arm.y() - chord.y() * arm.x()) / length};
}

}  // namespace bladefit
