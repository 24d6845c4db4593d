#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace bladefit {

/// How letters are made of characters.
struct BlockStyle {
  int scale = 1;       ///< cells that a dot is wide
  bool blocks = true;  ///< of half blocks, two dots in a cell; else of `#`, which take twice the rows
};

/// Rows that block letters take.
[[nodiscard]] int block_rows(const BlockStyle& style);

/// Cells that a text takes in them.
[[nodiscard]] int block_width(std::string_view text, const BlockStyle& style);

/// A text of capitals, digits and + - . / : % ? in letters of five dots height, block_rows() lines; what has no letter
/// is left blank.
[[nodiscard]] std::vector<std::string> block_letters(std::string_view text, const BlockStyle& style);

}  // namespace bladefit
