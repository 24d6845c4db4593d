#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// How a piece of text is shown, by its meaning. The colours are told apart by colour-blind people as well, and no
/// meaning hangs on them alone.
enum class Style { plain, strong, faint, in, cut, weld, undecided, trouble };

/// One line of the screen, built from left to right, never wider than its width. Control characters that set the style
/// do not count as width; a character of UTF-8 is one cell wide.
class StyledLine {
 public:
  /// `stale`: what the line says is old, so everything but trouble is faint.
  StyledLine(int width, bool colour, bool stale = false) : width_(width), colour_(colour), stale_(stale) {}

  /// Text that does not fit ends at a blank, and `>` says so: no number is cut.
  StyledLine& add(std::string_view text, Style style = Style::plain);

  /// Adds the text after a gap of two if there is room for all of it.
  StyledLine& field(std::string_view text, Style style = Style::plain);

  /// Fills up with blanks to `column`, counted from 0; at least one blank when the text is beyond it already.
  StyledLine& to(int column);

  /// Repeats a character to the end of the line.
  StyledLine& rule(char character);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] int room() const { return width_ - used_; }

 private:
  void put(std::string_view text, int cells, Style style);

  int width_;
  bool colour_, stale_;
  int used_ = 0;
  std::string text_;
};

/// Cells that a text of UTF-8 takes.
[[nodiscard]] int cells_of(std::string_view text);

}  // namespace bladefit
