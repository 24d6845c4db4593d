#include "tools/panel/styled_line.hpp"

#include <algorithm>

namespace bladefit {
namespace {

// Select graphic rendition of ECMA-48, 8.3.117; colours from the 256 that terminals agree on, nearest to the set of
// M. Okabe and K. Ito, Color Universal Design, 2008: bluish green, orange, sky blue, yellow, vermilion.
std::string_view code_of(Style style) {
  switch (style) {
    case Style::strong:
      return "\x1b[1m";
    case Style::faint:
      return "\x1b[2m";
    case Style::in:
      return "\x1b[38;5;36m";
    case Style::cut:
      return "\x1b[1;38;5;214m";
    case Style::weld:
      return "\x1b[1;38;5;75m";
    case Style::undecided:
      return "\x1b[38;5;227m";
    case Style::trouble:
      return "\x1b[1;7;38;5;202m";
    case Style::plain:
      break;
  }
  return "";
}

constexpr std::string_view kPlainAgain = "\x1b[0m";
constexpr int kGap = 2;

/// The text that fits in so many cells and ends before a blank.
std::string_view whole_words(std::string_view text, int cells) {
  std::size_t end = 0;
  int used = 0;
  for (std::size_t index = 0; index < text.size(); ++index) {
    if ((static_cast<unsigned char>(text[index]) & 0xC0U) == 0x80U) continue;
    if (text[index] == ' ' && used <= cells) end = index;
    if (++used > cells + 1) break;
  }
  return text.substr(0, end);
}

}  // namespace

int cells_of(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(
      text, [](char character) { return (static_cast<unsigned char>(character) & 0xC0U) != 0x80U; }));
}

StyledLine& StyledLine::add(std::string_view text, Style style) {
  const int cells = cells_of(text);
  if (cells <= room()) {
    put(text, cells, style);
  } else if (room() > 0) {
    const std::string cut = std::string(whole_words(text, room() - 1)) + ">";
    put(cut, cells_of(cut), style);
    width_ = used_;
  }
  return *this;
}

void StyledLine::put(std::string_view text, int cells, Style style) {
  if (stale_ && style != Style::trouble) style = Style::faint;
  const bool styled = colour_ && style != Style::plain && !text.empty();
  if (styled) text_ += code_of(style);
  text_ += text;
  if (styled) text_ += kPlainAgain;
  used_ += cells;
}

StyledLine& StyledLine::field(std::string_view text, Style style) {
  if (cells_of(text) + kGap > room()) return *this;
  return to(used_ + kGap).add(text, style);
}

StyledLine& StyledLine::to(int column) {
  const int blanks = std::min(std::max(column - used_, 1), std::max(room(), 0));
  put(std::string(static_cast<std::size_t>(blanks), ' '), blanks, Style::plain);
  return *this;
}

StyledLine& StyledLine::rule(char character) {
  const int cells = std::max(room(), 0);
  put(std::string(static_cast<std::size_t>(cells), character), cells, Style::faint);
  return *this;
}

}  // namespace bladefit
