#include "tools/results/zone_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "config/zone_settings.hpp"
#include "core/fit/fit_mode.hpp"

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

double tightest_zone(const Result& result, Region region) {
  double tightest = std::numeric_limits<double>::infinity();
  for (const ResultZone& zone : zones_and_rest(result)) {
    if (zone.region == region) tightest = std::min({tightest, zone.plus, zone.minus});
  }
  return tightest;
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

ZoneShare zone_share(const Result& result) {
  ZoneShare share;
  const bool by_zone = result.mode == word_of(FitMode::min_tolerance) || result.mode == word_of(FitMode::constrained);
  if (result.zones.empty() || !by_zone || !(result.tolerance_factor > 0.0)) return share;
  share.tightest = tightest_zone(result, share.region);
  if (!std::isfinite(share.tightest)) {
    share.region = Region::rest;
    share.tightest = tightest_zone(result, share.region);
  }
  if (std::isfinite(share.tightest)) share.factor = result.tolerance_factor / share.tightest;
  return share;
}

}  // namespace bladefit
