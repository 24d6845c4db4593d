#include "firmware_bridge/host/blade/next_place.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "firmware_bridge/host/blade/defects.hpp"
#include "firmware_bridge/host/blade/edge_gaps.hpp"

namespace bladefit {
namespace {

constexpr double kRounding = 1e-9;        ///< of the information, in place of what is not known at all
constexpr double kOffNose = 0.2;          ///< of the scale of the design, by which a place of the nose is preferred
constexpr std::size_t kFewestPlaces = 4;  ///< of a side in a band that is worth a word

/// A point there makes the least known direction of the pose known best.
const BladePlace* most_telling(const BladeLayout& layout, const Mat6& information) {
  const double floor = kRounding * (information.trace() + 1);
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(information + floor * Mat6::Identity());
  const auto gain = [&](const BladePlace& place) {
    const Vec6 row = motion_row(layout, place.point, place.normal);
    return row.dot(solver.solve(row));
  };
  const auto best = std::ranges::max_element(layout.places(), {}, gain);
  return best != layout.places().end() ? &*best : nullptr;
}

/// The place of the leading edge nearest to a radius, on the nose where there is one as near.
const BladePlace* edge_place(const BladeLayout& layout, double radius_mm) {
  const auto apart = [&](const BladePlace& place) {
    if (place.region != Region::leading_edge) return 2 * layout.scale_mm() + radius_mm;
    return std::abs(place.radius - radius_mm) + (place.side == BladeSide::nose ? 0 : kOffNose * layout.scale_mm());
  };
  const auto nearest = std::ranges::min_element(layout.places(), {}, apart);
  return nearest != layout.places().end() ? &*nearest : nullptr;
}

/// The middle one of the places of a side without points, from the root on.
const BladePlace* bare_place(const BladeLayout& layout, const BladeCounts& counts) {
  for (std::size_t band = 0; band < BladeView::kBands; ++band) {
    for (const BladeSide side : {BladeSide::suction, BladeSide::pressure}) {
      if (counts.points(side, band) > 0 || !has_surface(layout, side, band)) continue;
      std::vector<const BladePlace*> places;
      for (const BladePlace& place : layout.places()) {
        if (place.region == Region::rest && place.side == side && layout.band_of(place.radius) == band)
          places.push_back(&place);
      }
      return places[places.size() / 2];
    }
  }
  return nullptr;
}

NextPlace place_of(const BladeLayout& layout, const FitReport& report, NextReason reason, const BladePlace* place) {
  if (place == nullptr) return {};
  return {reason, place->side, static_cast<float>(layout.ratio_of(place->radius)),
          in_machine(report.pose, place->point)};
}

}  // namespace

bool has_surface(const BladeLayout& layout, BladeSide side, std::size_t band) {
  const auto there = [&](const BladePlace& place) {
    return place.region == Region::rest && place.side == side && layout.band_of(place.radius) == band;
  };
  return std::ranges::count_if(layout.places(), there) >= static_cast<std::ptrdiff_t>(kFewestPlaces);
}

NextPlace next_place(const BladeLayout& layout, const BladeCounts& counts, const FitReport& report) {
  const bool begun = counts.information().trace() > 0;
  if (begun && report.determined < report.free)
    return place_of(layout, report, NextReason::fit_open, most_telling(layout, counts.information()));
  if (layout.edge_tip_mm() > layout.edge_root_mm()) {
    std::array<EdgeCell, BladeView::kCells> edge{};
    for (std::size_t cell = 0; cell < edge.size(); ++cell) edge[cell] = counts.edge_cell(cell);
    const std::vector<EdgeGap> gaps = edge_gaps(edge);
    if (!gaps.empty()) {
      const EdgeGap longest = *std::ranges::max_element(gaps, {}, &EdgeGap::length);
      const double radius = layout.radius_of_cell((longest.first + longest.end) / 2);
      return place_of(layout, report, NextReason::edge_not_probed, edge_place(layout, radius));
    }
  }
  return place_of(layout, report, NextReason::rest_not_probed, bare_place(layout, counts));
}

}  // namespace bladefit
