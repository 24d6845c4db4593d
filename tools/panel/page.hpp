#pragma once
#include <string>
#include <vector>

#include "tools/panel/screen.hpp"
#include "tools/panel/styled_line.hpp"

namespace bladefit {

/// Column at which values stand behind their names.
inline constexpr int kValueColumn = 13;

/// Collects the lines of one screen in groups. Where there is no room for all, groups go, the least important first.
class Page {
 public:
  Page(const ScreenView& view, int width) : view_(view), width_(width) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] StyledLine line() const { return {width_, view_.colour, !view_.connected}; }
  /// A line that begins with a name and goes on at kValueColumn.
  [[nodiscard]] StyledLine named(std::string_view name) const;

  /// The next lines are a group; one of importance 0 stays.
  void group(int importance) { groups_.push_back({importance, {}}); }
  void put(const StyledLine& line) { groups_.back().lines.push_back(line.text()); }
  void rule() { put(line().rule('-')); }
  /// A text behind a name, broken into at most `most` lines; `>` where it does not end.
  void put_text(std::string_view name, std::string_view text, Style style, std::size_t most);

  /// Lines there are so far, of groups up to that importance.
  [[nodiscard]] std::size_t count(int importance) const;

  /// At most `height` lines; where `foot` is set the last group stands at the bottom.
  [[nodiscard]] std::vector<std::string> take(int height, bool foot);

 private:
  struct Group {
    int importance;
    std::vector<std::string> lines;
  };
  const ScreenView& view_;
  int width_;
  std::vector<Group> groups_;
};

/// The first line of every page: where the panel is, the session's state, the link.
void put_heading(const ScreenView& view, Page& page);

/// The last one: the keys.
void put_keys(const ScreenView& view, Page& page);

/// "NO ANSWER", "link up" ...
[[nodiscard]] std::string link_word(const ScreenView& view);

/// The colour of what is to be done.
[[nodiscard]] Style style_of(Action action);
[[nodiscard]] Style style_of(BladeState verdict);

}  // namespace bladefit
