#pragma once
#include <cstddef>
#include <string_view>

namespace bladefit {

/// Reads the numbers of one file, which have a decimal point or a decimal comma, one of them throughout. Never guesses:
/// separators of thousands are refused, and `1,234`, which may be either, needs a number in the file that tells.
class DecimalMark {
 public:
  /// Reads the number that fills `cell`, of a line of the file. Returns why it cannot be read, or an empty text.
  [[nodiscard]] std::string_view read(std::string_view cell, std::size_t line, double& value);

  /// The first line with a number such as `1,234` where no number of the file tells what its comma means; 0 = none.
  [[nodiscard]] std::size_t doubtful_line() const { return proven_ ? 0 : doubtful_line_; }

 private:
  [[nodiscard]] std::string_view read_comma(std::string_view cell, std::size_t comma, std::size_t line, double& value);

  bool point_ = false, comma_ = false;  ///< seen so far
  bool proven_ = false;                 ///< a comma was seen that cannot separate thousands
  std::size_t doubtful_line_ = 0;
};

}  // namespace bladefit
