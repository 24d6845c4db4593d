#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// Where in a text file an error is, and how to say so.
struct CsvPlace {
  std::string_view name;  ///< of the file
  std::size_t line = 0;   ///< counted from 1

  /// "name:line: what".
  [[nodiscard]] std::string say(std::string_view what) const;
};

/// The text with A-Z as a-z, whatever the locale is.
[[nodiscard]] std::string lower_case(std::string_view text);

/// The first 40 characters of `text` in quotation marks, for messages; what cannot be printed becomes '?'.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The first of `texts` in quotation marks, six or 100 characters at most, "and 131 more" for the others.
[[nodiscard]] std::string quoted_list(const std::vector<std::string_view>& texts);

/// Takes the first line off `text`, which must not be empty. A line ends with LF, CR LF or CR. `ended`, where it is
/// given, says whether the line has an end.
[[nodiscard]] std::string_view take_line(std::string_view& text, bool* ended = nullptr);

/// Takes the mark that some systems put before UTF-8 off the front of `text`, and that of the end of the file (Ctrl-Z)
/// with the padding behind it off its back. bad_input, without the file's name: UTF-16, or a packed workbook.
[[nodiscard]] Failure strip_marks(std::string_view& text);

/// Whether a line has a byte that no text file has.
[[nodiscard]] bool is_binary(std::string_view line);

}  // namespace bladefit
