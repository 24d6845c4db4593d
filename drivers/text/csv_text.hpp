#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bladefit {

/// Where in a text file an error is, and how to say so.
struct CsvPlace {
  std::string_view name;  ///< of the file
  std::size_t line = 0;   ///< counted from 1

  /// "name:line: what".
  [[nodiscard]] std::string say(std::string_view what) const;
};

/// The first 40 characters of `text` in quotation marks, for messages.
[[nodiscard]] std::string quoted(std::string_view text);

/// The cells of a line between its commas, without blanks around them.
[[nodiscard]] std::vector<std::string_view> cells_of(std::string_view line);

/// Takes the first line off `text`, which must not be empty, and returns it without blanks around it. A line ends with
/// LF, CR LF or CR.
[[nodiscard]] std::string_view take_line(std::string_view& text);

/// Takes the mark that some systems put before UTF-8 off `text`.
void skip_byte_order_mark(std::string_view& text);

/// Number of the line with the first byte that no text file has; 0 = none.
[[nodiscard]] std::size_t binary_line(std::string_view text);

}  // namespace bladefit
