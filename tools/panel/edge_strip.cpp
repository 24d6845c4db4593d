#include "tools/panel/edge_strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "firmware_bridge/host/blade/edge_gaps.hpp"
#include "tools/panel/panel_words.hpp"

namespace bladefit {
namespace {

/// What a cell looks like, from the worst on.
struct CellSign {
  EdgeCell cell;
  char sign;
  Style style;
};
constexpr std::array<CellSign, 7> kSigns = {{{EdgeCell::cut, '+', Style::cut},
                                             {EdgeCell::weld, '-', Style::weld},
                                             {EdgeCell::beyond, 'x', Style::undecided},
                                             {EdgeCell::undecided, '~', Style::undecided},
                                             {EdgeCell::pending, '?', Style::undecided},
                                             {EdgeCell::in, 'o', Style::in},
                                             {EdgeCell::not_probed, '.', Style::faint}}};

constexpr std::string_view kLegend = "+-o?.~x";  ///< what is seen most stands first

const CellSign& sign_of(char sign) {
  const auto* const found = std::ranges::find(kSigns, sign, &CellSign::sign);
  return found != kSigns.end() ? *found : kSigns.back();
}

/// A side of the blade: points in each tenth of r/R, from the first one that has surface on.
void put_side(BladeSide side, std::span<const std::uint16_t> bands, Page& page) {
  constexpr double kTenth = 0.1;
  const auto has_surface = [](std::uint16_t points) { return points != BladeView::kNoSurface; };
  const auto first = static_cast<std::size_t>(std::ranges::find_if(bands, has_surface) - bands.begin());
  if (first == bands.size()) return;
  StyledLine line = page.named(side_word(side));
  line.add(fmt::format("points by tenths from r/R {:.1f}:", kTenth * static_cast<double>(first)), Style::faint);
  for (const std::uint16_t points : bands.subspan(first)) {
    line.add(has_surface(points) ? fmt::format(" {}", points) : " -", points == 0 ? Style::undecided : Style::plain);
  }
  page.put(line);
}

}  // namespace

std::size_t place_size(const BladeView& blade, std::size_t room) {
  return std::max(pass_spacing(blade.edge), (blade.edge.size() + room - 1) / room);
}

std::string edge_signs(const BladeView& blade, std::size_t hundredths) {
  std::string signs;
  for (std::size_t first = 0; first < blade.edge.size(); first += hundredths) {
    const std::span cells = std::span(blade.edge).subspan(first, std::min(hundredths, blade.edge.size() - first));
    const auto* const worst = std::ranges::find_if(
        kSigns, [&](const CellSign& sign) { return std::ranges::find(cells, sign.cell) != cells.end(); });
    signs += worst != kSigns.end() ? worst->sign : '?';
  }
  return signs;
}

void put_edge_strip(const ScreenView& view, Page& page) {
  const BladeView& blade = view.state.blade;
  if (!view.state.has_blade || !(blade.edge_tip > blade.edge_root) || !(blade.tip > 0)) return;
  const auto ratio = [&blade](float radius) { return fmt::format("{:.2f}", static_cast<double>(radius / blade.tip)); };
  const std::string root = " root " + ratio(blade.edge_root) + "[", tip = "]" + ratio(blade.edge_tip) + " tip";
  const int room = page.width() - static_cast<int>(root.size() + tip.size());
  if (room < 1) return;
  const std::string signs = edge_signs(blade, place_size(blade, static_cast<std::size_t>(room)));
  const std::size_t wide = static_cast<std::size_t>(room) / signs.size();
  page.group(1);
  StyledLine line = page.line();
  line.add(root);
  for (const char sign : signs) line.add(std::string(wide, sign), sign_of(sign).style);
  page.put(line.add(tip));
  page.group(4);
  StyledLine legend = page.line();
  for (const char sign : kLegend)
    legend.field(fmt::format("{} {}", sign, cell_word(sign_of(sign).cell)), sign_of(sign).style);
  page.put(legend);
  page.group(5);
  put_side(BladeSide::suction, blade.suction, page);
  put_side(BladeSide::pressure, blade.pressure, page);
}

}  // namespace bladefit
