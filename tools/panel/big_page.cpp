#include "tools/panel/big_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "tools/panel/block_letters.hpp"
#include "tools/panel/page.hpp"
#include "tools/panel/panel_words.hpp"
#include "tools/panel/progress_lines.hpp"
#include "tools/panel/verdict_lines.hpp"
#include "tools/panel/worst_place.hpp"

namespace bladefit {
namespace {

constexpr int kLargestScale = 6;
constexpr std::size_t kLines = 4;

/// One line, from what says most to what is shortest.
struct BigLine {
  std::vector<std::string> choices;
  Style style = Style::strong;
};

std::string capitals(std::string text) {
  for (char& character : text) {
    if (character >= 'a' && character <= 'z') character = static_cast<char>(character - 'a' + 'A');
  }
  return text;
}

BigLine verdict_line(const ScreenView& view) {
  if (!view.known || !view.state.has_extension) return {{"-"}, Style::strong};
  return {{blade_words(view.state), short_blade_words(view.state)}, style_of(view.state.verdict)};
}

BigLine distance_line(const std::optional<WorstPlace>& worst) {
  if (!worst) return {{"-"}, Style::strong};
  const std::string distance = capitals(signed_mm(worst->distance));
  const std::string number = distance.substr(0, distance.find(' '));
  if (worst->action == Action::none) return {{distance, number}, Style::strong};
  const std::string action = " " + action_word(worst->action);
  return {{distance + action, number + action, number}, style_of(worst->action)};
}

BigLine place_line(const std::optional<WorstPlace>& worst) {
  if (!worst) return {{"-"}, Style::strong};
  const std::string point = fmt::format("POINT {}", worst->sequence);
  if (worst->defect == nullptr) return {{point, fmt::format("{}", worst->sequence)}, Style::strong};
  const std::string ratio = "R/R " + ratio_text(worst->defect->to_ratio);
  const std::string side = capitals(side_word(worst->defect->side));
  if (side.empty()) return {{ratio + " " + point, ratio}, Style::strong};
  return {{ratio + " " + side + " " + point, ratio + " " + side, ratio}, Style::strong};
}

BigLine progress_line(const ScreenView& view) {
  const PanelState& state = view.state;
  if (!view.connected) {
    const std::string age = capitals(duration_text(view.age_s));
    return {{"NO ANSWER " + age, "NO ANSWER"}, Style::trouble};
  }
  if (state.session == SessionState::fault) return {{"FAULT"}, Style::trouble};
  if ((state.alarms & kAlarmLinkLost) != 0) {
    const std::string since = capitals(duration_text(state.link_down_s));
    return {{"LINK LOST " + since, "LINK LOST", "LINK"}, Style::trouble};
  }
  if ((state.alarms & kAlarmDataGap) != 0) return {{"POINTS MISSING", "MISSING"}, Style::trouble};
  if (state.planned == 0) return {{fmt::format("{} POINTS", state.points), fmt::format("{}", state.points)}};
  const std::string count = fmt::format("{} / {}", state.points, state.planned);
  const std::string close = fmt::format("{}/{}", state.points, state.planned);
  if (state.ended) return {{count + " ENDED", close, fmt::format("{}", state.points)}};
  const double left = seconds_left(view);
  const std::string time = left >= 0 ? "  " + capitals(duration_text(left)) : "";
  return {{count + time, count, close, fmt::format("{}", state.points)}};
}

/// What of a line fits.
std::optional<std::string> fitting(const BigLine& line, const BlockStyle& style, int width) {
  const auto choice = std::ranges::find_if(
      line.choices, [&](const std::string& text) { return block_width(text, style) + 2 <= width; });
  return choice != line.choices.end() ? std::optional(*choice) : std::nullopt;
}

/// The largest letters of which four lines fit; nothing where none do.
std::optional<BlockStyle> largest_style(const std::array<BigLine, kLines>& lines, bool utf8, int width, int height) {
  for (int scale = kLargestScale; scale > 0; --scale) {
    const BlockStyle style{.scale = scale, .blocks = utf8};
    if (block_rows(style) * static_cast<int>(kLines) + 1 > height) continue;
    if (std::ranges::all_of(lines, [&](const BigLine& line) { return fitting(line, style, width).has_value(); }))
      return style;
  }
  return std::nullopt;
}

void put_big(const BigLine& line, const std::optional<BlockStyle>& style, Page& page) {
  page.group(0);
  if (!style) return page.put(page.line().add(" " + line.choices.front(), line.style));
  for (const std::string& row : block_letters(*fitting(line, *style, page.width()), *style)) {
    const Style shown = line.style == Style::trouble ? Style::cut : line.style;  // no letters of holes
    page.put(page.line().add(" ").add(row, shown));
  }
}

}  // namespace

std::vector<std::string> big_page(const ScreenView& view, int width, int height) {
  const std::optional<WorstPlace> worst = view.known ? worst_place(view.state) : std::nullopt;
  const std::array<BigLine, kLines> lines = {verdict_line(view), distance_line(worst), place_line(worst),
                                             progress_line(view)};
  const std::optional<BlockStyle> style = largest_style(lines, view.utf8, width, height);
  const int rows = style ? block_rows(*style) : 1;
  const int spare = height - 1 - rows * static_cast<int>(kLines);
  Page page(view, width);
  for (const BigLine& line : lines) {
    put_big(line, style, page);
    for (int blank = 0; blank < spare / static_cast<int>(kLines); ++blank) page.put(page.line());
  }
  page.group(1);
  put_keys(view, page);
  return page.take(height, true);
}

}  // namespace bladefit
