#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// How a piece of text is shown. Colours are told apart by colour-blind people as well (orange, blue), and no meaning
/// hangs on them alone.
enum class Style { plain, strong, faint, good, bad };

/// One line of the screen, built from left to right, cut at its width. Control characters that set the style do not
/// count as width. The text is ASCII.
class StyledLine {
 public:
  StyledLine(int width, bool colour) : width_(width), colour_(colour) {}

  StyledLine& add(std::string_view text, Style style = Style::plain);

  /// Fills up with blanks to `column`, counted from 0; at least one blank when the text is beyond it already.
  StyledLine& to(int column);

  /// Repeats a character to the end of the line.
  StyledLine& rule(char character);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  int width_;
  bool colour_;
  int used_ = 0;
  std::string text_;
};

}  // namespace bladefit
