#include "tools/panel/block_letters.hpp"

#include <array>
#include <utility>

namespace bladefit {
namespace {

constexpr int kDots = 5;  ///< in height

/// Rows of dots from the top, one behind the other: the width is a fifth of the length.
using Glyph = std::string_view;

constexpr std::pair<char, Glyph> kGlyphs[] = {
    {'A', "010101111101101"},
    {'B', "110101110101110"},
    {'C', "111100100100111"},
    {'D', "110101101101110"},
    {'E', "111100110100111"},
    {'F', "111100110100100"},
    {'G', "011100101101011"},
    {'H', "101101111101101"},
    {'I', "111010010010111"},
    {'J', "001001001101010"},
    {'K', "101101110101101"},
    {'L', "100100100100111"},
    {'M', "1000111011101011000110001"},
    {'N', "10011101101110011001"},
    {'O', "111101101101111"},
    {'P', "110101110100100"},
    {'Q', "111101101111001"},
    {'R', "110101110101101"},
    {'S', "111100111001111"},
    {'T', "111010010010010"},
    {'U', "101101101101111"},
    {'V', "101101101101010"},
    {'W', "1000110001101011101110001"},
    {'X', "101101010101101"},
    {'Y', "101101010010010"},
    {'Z', "111001010100111"},
    {'0', "111101101101111"},
    {'1', "010110010010111"},
    {'2', "111001111100111"},
    {'3', "111001011001111"},
    {'4', "101101111001001"},
    {'5', "111100111001111"},
    {'6', "111100111101111"},
    {'7', "111001001001001"},
    {'8', "111101111101111"},
    {'9', "111101111001111"},
    {'+', "000010111010000"},
    {'-', "000000111000000"},
    {'.', "00001"},
    {'/', "001001010100100"},
    {':', "01010"},
    {'%', "101001010100101"},
    {'?', "110001010000010"},
    {' ', "0000000000"},
};

Glyph glyph_of(char character) {
  for (const auto& [key, glyph] : kGlyphs) {
    if (key == character) return glyph;
  }
  return glyph_of(' ');
}

int dots_wide(Glyph glyph) { return static_cast<int>(glyph.size()) / kDots; }

/// The dots of a text, a row a line, '1' where there is one.
std::array<std::string, kDots> dots_of(std::string_view text, int scale) {
  std::array<std::string, kDots> rows;
  for (const char character : text) {
    const Glyph glyph = glyph_of(character);
    const auto width = static_cast<std::size_t>(dots_wide(glyph));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (!rows[row].empty()) rows[row].append(static_cast<std::size_t>(scale), '0');
      for (std::size_t dot = 0; dot < width; ++dot) {
        rows[row].append(static_cast<std::size_t>(scale), glyph[row * width + dot]);
      }
    }
  }
  return rows;
}

}  // namespace

int block_rows(const BlockStyle& style) {
  const int rows = kDots * style.scale;
  return style.blocks ? (rows + 1) / 2 : rows;
}

int block_width(std::string_view text, const BlockStyle& style) {
  int width = 0;
  for (const char character : text) width += (dots_wide(glyph_of(character)) + 1) * style.scale;
  return width > 0 ? width - style.scale : 0;
}

std::vector<std::string> block_letters(std::string_view text, const BlockStyle& style) {
  const std::array<std::string, kDots> dots = dots_of(text, style.scale);
  const auto dot_at = [&](int row, std::size_t column) {
    const auto line = static_cast<std::size_t>(row / style.scale);
    return line < dots.size() && dots[line][column] == '1';
  };
  std::vector<std::string> lines(static_cast<std::size_t>(block_rows(style)));
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const auto row = static_cast<int>(line);
    for (std::size_t column = 0; column < dots[0].size(); ++column) {
      if (!style.blocks) {
        lines[line] += dot_at(row, column) ? "#" : " ";
        continue;
      }
      const bool upper = dot_at(2 * row, column), lower = dot_at(2 * row + 1, column);
      lines[line] += upper && lower ? "█" : upper ? "▀" : lower ? "▄" : " ";
    }
  }
  return lines;
}

}  // namespace bladefit
