#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bladefit {

/// What the framer made of the bytes so far.
struct FramedLine {
  std::string text;    ///< between `$` and the end of the line, both left out
  std::string damage;  ///< why it is no line; empty = it is one
};

/// Cuts a stream of bytes into lines that begin with `$` and end with a line feed. Noise between lines, a line that
/// another one interrupts and an endless line cost themselves only: the next `$` is a new beginning.
class LineFramer {
 public:
  /// Takes bytes as they came. Cost: linear.
  void add(std::string_view bytes) { input_ += bytes; }

  /// The next line or piece of damage; nothing until more bytes come.
  [[nodiscard]] std::optional<FramedLine> next();

  /// Forgets a line begun.
  void reset();

 private:
  [[nodiscard]] std::optional<FramedLine> take(char byte);

  std::string input_;
  std::size_t used_ = 0;  ///< of input_
  std::string line_;
  bool inside_ = false;    ///< a `$` has come and its line end has not
  std::size_t noise_ = 0;  ///< bytes outside of lines since the last line
};

}  // namespace bladefit
