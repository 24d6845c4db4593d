#include "tools/panel/progress_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "firmware_bridge/host/blade/edge_gaps.hpp"
#include "tools/panel/panel_words.hpp"
#include "tools/panel/worst_place.hpp"

namespace bladefit {
namespace {

constexpr int kBarCells = 10, kLeastBarWidth = 80;

std::string bar(double share) {
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * kBarCells);
  return "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(kBarCells - full), '.') + "]";
}

void put_points(const ScreenView& view, Page& page) {
  constexpr double kPercent = 100;
  const PanelState& state = view.state;
  StyledLine line = page.named("points");
  if (state.planned > 0) {
    line.add(fmt::format("{} of {}", state.points, state.planned), Style::strong);
    const double share = static_cast<double>(state.points) / static_cast<double>(state.planned);
    if (page.width() >= kLeastBarWidth && !state.ended) line.field(bar(share));
    line.field(fmt::format("{:.0f} %", std::min(kPercent * share, kPercent)));
  } else {
    line.add(fmt::format("{}", state.points), Style::strong);
  }
  if (state.ended) return page.put(line.field("ended: this is the result", Style::strong));
  const double left = seconds_left(view);
  if (left > 0) line.field(fmt::format("{} left", duration_text(left)));
  const bool waits = !(view.points_per_second > 0);
  line.field(waits ? "waiting for points" : fmt::format("{:.1f} a second", view.points_per_second));
  if (state.rejected > 0) line.field(fmt::format("{} do not count", state.rejected));
  page.put(line);
}

std::string next_words(const BladeView& blade) {
  const NextPlace& next = blade.next;
  if (next.reason == NextReason::none) return {};
  const bool edge = next.reason == NextReason::edge_not_probed;
  std::string text = next.reason == NextReason::fit_open ? "to fix the fit: " : "";
  if (edge) text += "leading edge ";
  const std::string span = span_words(blade, next.ratio), side = side_word(next.side);
  text += span;
  if (!side.empty()) text += (span.empty() ? "" : ", ") + side + (next.side == BladeSide::nose ? "" : " side");
  return text + " r/R " + ratio_text(next.ratio);
}

/// The bands of a side without points, those next to each other put together.
void add_bands(std::span<const std::uint16_t> bands, BladeSide side, std::vector<std::string>& regions) {
  std::vector<std::string> stretches;
  for (std::size_t band = 0; band < bands.size(); ++band) {
    if (bands[band] != 0) continue;
    const std::size_t first = band;
    while (band + 1 < bands.size() && bands[band + 1] == 0) ++band;
    constexpr double kTenth = 0.1;
    stretches.push_back(
        fmt::format("{:.1f}-{:.1f}", kTenth * static_cast<double>(first), kTenth * static_cast<double>(band + 1)));
  }
  if (!stretches.empty()) regions.push_back(fmt::format("{} side r/R {}", side_word(side), fmt::join(stretches, " ")));
}

}  // namespace

double seconds_left(const ScreenView& view) {
  const PanelState& state = view.state;
  if (state.planned == 0 || state.points > state.planned || !(view.points_per_second > 0)) return -1;
  return (state.planned - state.points) / view.points_per_second;
}

std::vector<std::string> not_probed(const BladeView& blade) {
  std::vector<std::string> regions;
  if (!(blade.edge_tip > blade.edge_root) || !(blade.tip > 0)) return regions;
  const auto ratio = [&blade](std::size_t cell) {
    const float share = static_cast<float>(cell) / static_cast<float>(BladeView::kCells);
    return (blade.edge_root + share * (blade.edge_tip - blade.edge_root)) / blade.tip;
  };
  std::vector<std::string> gaps;
  for (const EdgeGap& gap : edge_gaps(blade.edge)) {
    const auto first = static_cast<double>(ratio(gap.first)), end = static_cast<double>(ratio(gap.end));
    gaps.push_back(fmt::format("{:.2f}-{:.2f}", first, end));
  }
  if (!gaps.empty()) regions.push_back(fmt::format("leading edge r/R {}", fmt::join(gaps, " ")));
  add_bands(blade.suction, BladeSide::suction, regions);
  add_bands(blade.pressure, BladeSide::pressure, regions);
  return regions;
}

void put_progress(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  page.group(1);
  put_points(view, page);
  if (!state.has_blade) return;
  page.group(3);
  const std::string next = next_words(state.blade);
  if (!next.empty() && !state.ended) {
    StyledLine line = page.named("probe next");
    page.put(line.add(next, Style::strong).field(machine_words(state.blade.next.machine), Style::faint));
  }
  page.group(5);
  const std::vector<std::string> regions = not_probed(state.blade);
  if (regions.empty()) return;
  StyledLine line = page.named("not probed");
  page.put(line.add(fmt::format("{}", fmt::join(regions, "; "))));
}

}  // namespace bladefit
