#include "firmware_bridge/host/blade/view_of_blade.hpp"

#include <algorithm>

#include "firmware_bridge/host/blade/defects.hpp"
#include "firmware_bridge/host/blade/next_place.hpp"

namespace bladefit {
namespace {

std::uint16_t points_there(const BladeLayout& layout, const BladeCounts& counts, BladeSide side, std::size_t band) {
  const std::uint32_t points = counts.points(side, band);
  if (points == 0 && !has_surface(layout, side, band)) return BladeView::kNoSurface;
  return static_cast<std::uint16_t>(std::min<std::uint32_t>(points, BladeView::kNoSurface - 1));
}

}  // namespace

BladeView view_of_blade(const BladeLayout& layout, const BladeCounts& counts, const FitReport& report) {
  BladeView view;
  view.edge_root = static_cast<float>(layout.edge_root_mm());
  view.edge_tip = static_cast<float>(layout.edge_tip_mm());
  view.tip = static_cast<float>(layout.tip_radius_mm());
  for (std::size_t cell = 0; cell < BladeView::kCells; ++cell) view.edge[cell] = counts.edge_cell(cell);
  for (std::size_t band = 0; band < BladeView::kBands; ++band) {
    view.suction[band] = points_there(layout, counts, BladeSide::suction, band);
    view.pressure[band] = points_there(layout, counts, BladeSide::pressure, band);
  }
  view.next = next_place(layout, counts, report);
  const std::vector<BladeDefect> defects = joined_defects(layout, counts.out(), report.pose);
  view.defect_count = static_cast<std::uint32_t>(defects.size());
  std::copy_n(defects.begin(), std::min(defects.size(), BladeView::kDefects), view.defects.begin());
  return view;
}

}  // namespace bladefit
