#include "tools/panel/defect_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/panel/panel_words.hpp"
#include "tools/panel/worst_place.hpp"

namespace bladefit {
namespace {

constexpr int kPlaceColumns = 78, kPointColumns = 94;  ///< screens with room for machine coordinates; for points

std::string where(const BladeDefect& defect) {
  const std::string side = side_word(defect.side);
  const std::string region = defect.region == Region::leading_edge ? "edge" : "rest";
  return side.empty() ? region : region + " " + side;
}

void put_defect(const BladeDefect& defect, Page& page) {
  StyledLine line = page.line();
  const std::string distance = signed_mm(defect.distance);
  line.add(fmt::format(" {}-{}  {:>6.1f}  {:<13}  ", ratio_text(defect.from_ratio), ratio_text(defect.to_ratio),
                       static_cast<double>(defect.length), where(defect)));
  line.add(fmt::format("{:<4} {:>7}", defect.action == Action::none ? "-" : action_word(defect.action),
                       distance.substr(0, distance.find(' '))),
           style_of(defect.action));
  if (page.width() >= kPlaceColumns) {
    line.add(fmt::format("  {:>8} {:>8} {:>8}", machine_mm(defect.machine[0]), machine_mm(defect.machine[1]),
                         machine_mm(defect.machine[2])));
  }
  if (page.width() >= kPointColumns) line.add(fmt::format("  {:>6} {:>8}", defect.points, defect.sequence));
  page.put(line);
}

}  // namespace

void put_defects(const ScreenView& view, Page& page, int rows) {
  const BladeView& blade = view.state.blade;
  if (!view.state.has_blade || blade.defects[0].sequence == 0 || rows < 2) return;
  page.group(0);
  StyledLine heading = page.line();
  heading.add("   r/R from-to  length  where          do    by mm", Style::faint);
  if (page.width() >= kPlaceColumns) heading.add("  machine x        y        z", Style::faint);
  if (page.width() >= kPointColumns) heading.add("  points    worst", Style::faint);
  page.put(heading);
  const auto known = static_cast<std::uint32_t>(
      std::ranges::count_if(blade.defects, [](const BladeDefect& defect) { return defect.sequence != 0; }));
  const std::uint32_t all = std::max(blade.defect_count, known);
  const auto room = static_cast<std::uint32_t>(rows - 1);
  const std::uint32_t shown = all <= std::min(room, known) ? all : std::min(room - 1, known);
  for (std::uint32_t row = 0; row < shown; ++row) put_defect(blade.defects[row], page);
  if (shown < all) page.put(page.line().add(fmt::format("   and {} more", all - shown), Style::faint));
}

}  // namespace bladefit
