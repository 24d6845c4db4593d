#pragma once
#include <array>
#include <string_view>
#include <vector>

namespace bladefit {

/// The separator that stands for any run of blanks and tabs.
inline constexpr char kBlanks = ' ';

/// What may separate the cells of a line, in the order in which a file is tried.
inline constexpr std::array<char, 5> kSeparators = {';', '\t', ',', '|', kBlanks};

/// Cuts a line into its cells, each without blanks and quotation marks around it; the rules are those of RFC 4180.
/// Returns what is wrong with the quotation marks, or an empty text.
[[nodiscard]] std::string_view split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

}  // namespace bladefit
