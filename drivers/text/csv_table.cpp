#include "drivers/text/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

std::string unknown_column(const CsvPlace& place, std::string_view cell, std::string_view line, std::string_view fix) {
  if (line.find(';') != std::string_view::npos) {
    return place.say(fmt::format("the columns are separated by ';'; separate them by ','"));
  }
  if (parse_finite(cell))
    return place.say(fmt::format("a number, {}, stands where a column's name should; {}", quoted(cell), fix));
  return place.say(fmt::format("unknown column {}; {}", quoted(cell), fix));
}

Failure read_names(const CsvPlace& place, std::string_view line, const CsvFormat& format,
                   std::vector<std::size_t>& columns) {
  std::vector<bool> seen(format.columns.size());
  for (const std::string_view cell : cells_of(line)) {
    const auto found = std::find(format.columns.begin(), format.columns.end(), cell);
    if (found == format.columns.end()) return bad_input(unknown_column(place, cell, line, format.fix));
    const auto column = static_cast<std::size_t>(found - format.columns.begin());
    if (seen[column])
      return bad_input(place.say(fmt::format("column {} is named twice; {}", quoted(cell), format.fix)));
    seen[column] = true;
    columns.push_back(column);
  }
  bool any = false;
  for (std::size_t column = format.needed; column < format.together; ++column) any = any || seen[column];
  for (std::size_t column = 0; column < (any ? format.together : format.needed); ++column) {
    if (!seen[column])
      return bad_input(place.say(fmt::format("column '{}' is missing; {}", format.columns[column], format.fix)));
  }
  return {};
}

}  // namespace

Failure read_csv_table(std::string_view text, std::string_view name, const CsvFormat& format,
                       const std::function<Failure(const CsvRow&)>& take) {
  skip_byte_order_mark(text);
  CsvRow row;
  row.place = {name, 1};
  if (const std::size_t line = binary_line(text); line != 0) {
    return bad_input(
        CsvPlace{name, line}.say(fmt::format("a control character: this is no CSV text file; {}", format.fix)));
  }
  for (; !text.empty(); ++row.place.line) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#') continue;
    if (row.columns.empty()) {
      if (Failure failure = read_names(row.place, line, format, row.columns)) return failure;
      continue;
    }
    row.cells = cells_of(line);
    if (row.cells.size() != row.columns.size()) {
      return bad_input(
          row.place.say(fmt::format("{} columns where the first line names {}", row.cells.size(), row.columns.size())));
    }
    if (Failure failure = take(row)) return failure;
  }
  if (row.columns.empty()) return bad_input(fmt::format("{}: the file is empty; {}", name, format.fix));
  return {};
}

Failure finite_cell(const CsvRow& row, std::size_t cell, const CsvFormat& format, double& value) {
  const std::optional<double> number = parse_finite(row.cells[cell]);
  if (!number) {
    return bad_input(row.place.say(fmt::format("column {}: {} is not a finite number; write it like -12.345",
                                               format.columns[row.columns[cell]], quoted(row.cells[cell]))));
  }
  value = *number;
  return {};
}

}  // namespace bladefit
