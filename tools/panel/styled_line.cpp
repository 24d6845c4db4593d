#include "tools/panel/styled_line.hpp"

#include <algorithm>

namespace bladefit {
namespace {

// Select graphic rendition of ECMA-48, 8.3.117; orange and blue from the 256 colours that terminals agree on.
std::string_view code_of(Style style) {
  switch (style) {
    case Style::strong:
      return "\x1b[1m";
    case Style::faint:
      return "\x1b[2m";
    case Style::good:
      return "\x1b[38;5;33m";
    case Style::bad:
      return "\x1b[1;38;5;208m";
    case Style::plain:
      break;
  }
  return "";
}

constexpr std::string_view kPlainAgain = "\x1b[0m";

}  // namespace

StyledLine& StyledLine::add(std::string_view text, Style style) {
  const std::string_view shown = text.substr(0, static_cast<std::size_t>(std::max(width_ - used_, 0)));
  const bool styled = colour_ && style != Style::plain && !shown.empty();
  if (styled) text_ += code_of(style);
  text_ += shown;
  if (styled) text_ += kPlainAgain;
  used_ += static_cast<int>(shown.size());
  return *this;
}

StyledLine& StyledLine::to(int column) {
  return add(std::string(static_cast<std::size_t>(std::max(column - used_, 1)), ' '));
}

StyledLine& StyledLine::rule(char character) {
  return add(std::string(static_cast<std::size_t>(std::max(width_ - used_, 0)), character), Style::faint);
}

}  // namespace bladefit
