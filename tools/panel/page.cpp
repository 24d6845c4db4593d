#include "tools/panel/page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/panel/panel_words.hpp"

namespace bladefit {
namespace {

constexpr int kAll = 1000;  ///< more than any importance

/// Takes from `text` the words that fit in so many cells: at least one.
std::string_view next_words(std::string_view& text, int cells) {
  std::size_t end = text.size();
  if (cells_of(text) > cells) {
    const std::size_t most = std::min(text.size(), static_cast<std::size_t>(std::max(cells, 1)));
    end = text.rfind(' ', most);
    if (end == std::string_view::npos || end == 0) end = std::min(text.find(' '), text.size());
  }
  const std::string_view words = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return words;
}

}  // namespace

StyledLine Page::named(std::string_view name) const {
  StyledLine made = line();
  made.add(" ").add(name, Style::faint).to(kValueColumn);
  return made;
}

void Page::put_text(std::string_view name, std::string_view text, Style style, std::size_t most) {
  const int closer = static_cast<int>(name.size()) + 2;
  if (cells_of(text) > width_ - kValueColumn && cells_of(text) <= width_ - closer)
    return put(line().add(" ").add(name, Style::faint).add(" ").add(text, style));
  for (std::size_t row = 0; row < most && !text.empty(); ++row) {
    const bool last = row + 1 == most;
    StyledLine made = named(row == 0 ? name : "");
    put(made.add(last ? text : next_words(text, made.room()), style));
    if (last) return;
  }
}

std::size_t Page::count(int importance) const {
  std::size_t lines = 0;
  for (const Group& group : groups_) {
    if (group.importance <= importance) lines += group.lines.size();
  }
  return lines;
}

std::vector<std::string> Page::take(int height, bool foot) {
  const auto most = static_cast<std::size_t>(std::max(height, 0));
  while (count(kAll) > most) {
    const auto least = std::ranges::max_element(
        groups_, {}, [](const Group& group) { return group.lines.empty() ? -1 : group.importance; });
    if (least == groups_.end() || least->importance == 0 || least->lines.empty()) break;
    least->lines.clear();
  }
  std::vector<std::string> lines;
  for (const Group& group : groups_) {
    const bool last = foot && &group == &groups_.back();
    while (last && lines.size() + group.lines.size() < most) lines.emplace_back();
    lines.insert(lines.end(), group.lines.begin(), group.lines.end());
  }
  if (lines.size() > most) lines.resize(most);
  return lines;
}

std::string link_word(const ScreenView& view) {
  if (!view.connected) return "NO ANSWER";
  if (view.state.ended) return "ended";
  if (view.state.session == SessionState::connecting) return "link connecting";
  return (view.state.alarms & kAlarmLinkLost) != 0 ? "link LOST" : "link up";
}

void put_heading(const ScreenView& view, Page& page) {
  const bool lost = !view.connected || (view.state.alarms & kAlarmLinkLost) != 0;
  StyledLine line = page.line();
  line.add(" bladefit", Style::strong);
  line.field(view.known ? "session " + session_word(view.state.session) : "waiting", Style::strong);
  line.field(link_word(view), lost ? Style::trouble : Style::in);
  page.put(line.field("panel " + view.address, Style::faint));
}

void put_keys(const ScreenView& view, Page& page) { page.put(page.line().add(" " + view.keys, Style::faint)); }

Style style_of(Action action) {
  if (action == Action::none) return Style::undecided;
  return action == Action::cut ? Style::cut : Style::weld;
}

Style style_of(BladeState verdict) {
  switch (verdict) {
    case BladeState::in_tolerance:
      return Style::in;
    case BladeState::out_of_tolerance:
      return Style::cut;
    case BladeState::not_decided:
      return Style::undecided;
    case BladeState::not_judged:
      break;
  }
  return Style::strong;
}

}  // namespace bladefit
