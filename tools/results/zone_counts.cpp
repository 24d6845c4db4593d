#include "tools/results/zone_counts.hpp"

#include <algorithm>

#include "config/zone_settings.hpp"

namespace bladefit {
namespace {

void count_point(const ResultPoint& point, ZoneCounts& counts) {
  counts.most = counts.points == 0 ? point.distance : std::max(counts.most, point.distance);
  counts.least = counts.points == 0 ? point.distance : std::min(counts.least, point.distance);
  ++counts.points;
  switch (point.state) {
    case PointState::in:
      ++counts.in;
      break;
    case PointState::out:
      ++(point.action == Action::cut ? counts.cut : point.action == Action::weld ? counts.weld : counts.beyond);
      break;
    case PointState::pending:
    case PointState::undecided:
      ++counts.open;
      break;
    case PointState::rejected:
      break;
  }
}

}  // namespace

std::vector<ZoneCounts> zone_counts(const Result& result) {
  std::vector<ZoneCounts> counts(result.zones.size() + 1);
  for (const ResultPoint& point : result.points) {
    if (point.state == PointState::rejected) continue;
    count_point(point, point.zone == 0 ? counts.back() : counts.at(point.zone - 1U));
  }
  return counts;
}

std::string zone_name(const Result& result, std::uint32_t zone) {
  return zone == 0 ? std::string(kRestName) : result.zones.at(zone - 1).name;
}

std::vector<ResultZone> zones_and_rest(const Result& result) {
  std::vector<ResultZone> zones = result.zones;
  if (zones.empty()) return zones;
  zones.push_back(
      {std::string(kRestName), "outside of all zones", Region::rest, result.rest_outside, result.rest_outside});
  return zones;
}

}  // namespace bladefit
