#include "tools/drawing/stations.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

constexpr int kStations = 120;
constexpr double kLeastChord = 1e-6;  ///< shares of the radius

/// The end of a piece that is farthest from a place.
UnrolledPlace farthest_from(const std::vector<SectionPiece>& pieces, const UnrolledPlace& place) {
  UnrolledPlace best = place;
  double most = -1;
  for (const SectionPiece& piece : pieces) {
    for (const UnrolledPlace& end : {piece.from, piece.to}) {
      const double apart = (end - place).squaredNorm();
      if (apart <= most) continue;
      most = apart;
      best = end;
    }
  }
  return best;
}

}  // namespace

std::optional<BladeStation> station_of(const std::vector<SectionPiece>& pieces, double radius) {
  UnrolledPlace edge = UnrolledPlace::Zero();
  double count = 0;
  for (const SectionPiece& piece : pieces) {
    if (!piece.leading_edge) continue;
    edge += piece.from + piece.to;
    count += 2;
  }
  if (pieces.empty()) return std::nullopt;
  edge = count > 0 ? UnrolledPlace(edge / count) : pieces.front().from;
  UnrolledPlace trailing = farthest_from(pieces, edge), leading = farthest_from(pieces, trailing);
  trailing = farthest_from(pieces, leading);
  leading = farthest_from(pieces, trailing);
  if ((leading - trailing).norm() <= kLeastChord * radius) return std::nullopt;
  return BladeStation{radius, leading.x(), leading.y() / radius, trailing.x(), trailing.y() / radius};
}

std::vector<BladeStation> stations_of(const RadiusGrid& grid) {
  std::vector<BladeStation> stations;
  const double least = grid.least_radius(), most = grid.greatest_radius();
  if (!(most > least)) return stations;
  for (int k = 0; k < kStations; ++k) {
    // Halfway into each of so many rings, closer to the ends of the first and the last.
    const double share = k == 0 ? 0.1 : k == kStations - 1 ? kStations - 0.1 : k + 0.5;
    const double radius = least + (most - least) * share / kStations;
    if (const auto station = station_of(grid.cut(radius), radius)) stations.push_back(*station);
  }
  return stations;
}

BladeStation station_at(const std::vector<BladeStation>& stations, double radius) {
  const auto after = std::ranges::lower_bound(stations, radius, {}, &BladeStation::radius);
  if (after == stations.begin()) return stations.front();
  if (after == stations.end()) return stations.back();
  const BladeStation &a = *(after - 1), &b = *after;
  const double share = (radius - a.radius) / (b.radius - a.radius);
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {radius, between(a.leading_along, b.leading_along), between(a.leading_angle, b.leading_angle),
          between(a.trailing_along, b.trailing_along), between(a.trailing_angle, b.trailing_angle)};
}

}  // namespace bladefit
