#include "tools/panel/verdict_lines.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "firmware_bridge/host/panel/panel_texts.hpp"
#include "tools/panel/block_letters.hpp"
#include "tools/panel/panel_words.hpp"
#include "tools/panel/worst_place.hpp"

namespace bladefit {
namespace {

constexpr int kLeastBlockHeight = 15, kLeastSharpHeight = 24;  ///< screens with room for block letters; made of `#`
constexpr int kBlockGap = 4;

/// What stands in block letters on one line: the verdict, and the worst distance.
struct Large {
  std::string verdict, worst;
};

/// From what says most to what is shortest.
std::vector<Large> large_choices(const PanelState& state) {
  const std::string full = blade_words(state), brief = short_blade_words(state);
  const std::optional<WorstPlace> worst = worst_place(state);
  if (!worst) return {{full, ""}, {brief, ""}};
  std::string distance = signed_mm(worst->distance);
  for (char& character : distance) character = character == 'm' ? 'M' : character;
  const std::string number = distance.substr(0, distance.find(' '));
  const std::string action = worst->action == Action::none ? "" : " " + action_word(worst->action);
  return {{full, distance + action},
          {full, distance},
          {brief, distance + action},
          {brief, distance},
          {brief, number},
          {full, ""},
          {brief, ""}};
}

void put_large(const ScreenView& view, Page& page) {
  const BlockStyle style{.scale = 1, .blocks = view.utf8};
  const std::optional<WorstPlace> worst = worst_place(view.state);
  for (const Large& large : large_choices(view.state)) {
    const int width = block_width(large.verdict, style), gap = large.worst.empty() ? 0 : kBlockGap;
    if (width + gap + block_width(large.worst, style) + 2 > page.width()) continue;
    const std::vector<std::string> left = block_letters(large.verdict, style),
                                   right = block_letters(large.worst, style);
    for (std::size_t row = 0; row < left.size(); ++row) {
      StyledLine line = page.line();
      line.add(" ").add(left[row], style_of(view.state.verdict));
      if (gap > 0)
        line.to(width + gap).add(right[row], worst->action == Action::none ? Style::strong : style_of(worst->action));
      page.put(line);
    }
    return;
  }
}

void put_worst(const PanelState& state, Page& page) {
  const std::optional<WorstPlace> worst = worst_place(state);
  if (!worst) return page.put(page.named("worst").add("- no point is judged yet"));
  StyledLine line = page.named("worst");
  const std::string action = worst->action == Action::none ? "" : " " + action_word(worst->action);
  line.add(signed_mm(worst->distance) + action,
           worst->action == Action::none ? Style::strong : style_of(worst->action));
  if (worst->defect != nullptr) {
    line.field(where_words(worst->region, worst->defect->side)).field("r/R " + ratio_text(worst->defect->to_ratio));
  } else {
    line.field(where_words(worst->region, BladeSide::unknown));
  }
  line.field(fmt::format("point {}", worst->sequence));
  if (worst->defect != nullptr) line.field(machine_words(worst->defect->machine), Style::faint);
  page.put(line);
}

}  // namespace

std::string blade_words(const PanelState& state) {
  PanelState bare;
  bare.verdict = state.verdict;
  return verdict_words(bare);
}

std::string short_blade_words(const PanelState& state) {
  static constexpr std::array<std::string_view, 4> kWords = {"NOT JUDGED", "IN", "OUT", "NOT DECIDED"};
  const auto verdict = static_cast<std::size_t>(state.verdict);
  return std::string(verdict < kWords.size() ? kWords[verdict] : "?");
}

void put_verdict(const ScreenView& view, Page& page, int height) {
  const PanelState& state = view.state;
  page.group(0);
  if (!view.known || !state.has_extension) return page.put(page.named("verdict").add("-"));
  const bool large = height >= (view.utf8 ? kLeastBlockHeight : kLeastSharpHeight);
  if (large) put_large(view, page);
  page.group(!large ? 0 : state.reasons == 0 ? 3 : 2);
  page.put_text("verdict", verdict_words(state), style_of(state.verdict), height >= kScreenHeight ? 2 : 1);
  page.group(0);
  put_worst(state, page);
  page.put_text("do", advice_words(state), Style::strong, 2);
}

}  // namespace bladefit
