#include "drivers/text/csv_cells.hpp"

#include <algorithm>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

std::string_view blanks_beside(char separator) { return separator == '\t' ? " " : " \t"; }

/// Where the quotation mark at the front closes; two in a row stand for one. npos: nowhere.
std::size_t closing_quote(std::string_view text) {
  for (std::size_t place = text.find('"', 1); place != std::string_view::npos; place = text.find('"', place + 2)) {
    if (place + 1 >= text.size() || text[place + 1] != '"') return place;
  }
  return std::string_view::npos;
}

/// Whether a cell ends where `rest` begins.
bool at_cell_end(std::string_view rest, char separator) {
  if (rest.empty() || rest.front() == separator) return true;
  return separator == kBlanks && rest.front() == '\t';
}

/// Takes the cell at the front of `rest`, without blanks before it, off it.
std::string_view take_cell(std::string_view& rest, char separator, std::string_view& wrong) {
  std::string_view cell;
  if (!rest.starts_with('"')) {
    const std::size_t end = separator == kBlanks ? rest.find_first_of(" \t") : rest.find(separator);
    cell = rest.substr(0, end);
    rest.remove_prefix(cell.size());
    return trimmed(cell);
  }
  const std::size_t close = closing_quote(rest);
  if (close == std::string_view::npos) {
    wrong = "a quotation mark is not closed in this line; close it";
    return {};
  }
  cell = rest.substr(1, close - 1);
  rest.remove_prefix(close + 1);
  if (separator != kBlanks) rest.remove_prefix(std::min(rest.find_first_not_of(blanks_beside(separator)), rest.size()));
  if (!at_cell_end(rest, separator)) wrong = "text follows a closing quotation mark; put a separator between";
  return trimmed(cell);
}

}  // namespace

std::string_view split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  std::string_view rest = line, wrong;
  while (wrong.empty()) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks_beside(separator)), rest.size()));
    if (separator == kBlanks && rest.empty()) break;
    cells.push_back(take_cell(rest, separator, wrong));
    if (separator == kBlanks) continue;
    if (rest.empty()) break;
    rest.remove_prefix(1);
  }
  return wrong;
}

}  // namespace bladefit
