#include "drivers/text/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

std::string unknown_column(const CsvPlace& place, std::string_view cell, std::string_view line, std::string_view mend) {
  if (line.find(';') != std::string_view::npos) {
    return place.say(fmt::format("the columns are separated by ';'; separate them by ','"));
  }
  if (parse_finite(cell))
    return place.say(fmt::format("a number, {}, stands where a column's name should; {}", quoted(cell), mend));
  return place.say(fmt::format("unknown column {}; {}", quoted(cell), mend));
}

std::string read_names(const CsvPlace& place, std::string_view line, const CsvFormat& format,
                       std::vector<std::size_t>& columns) {
  std::vector<bool> seen(format.columns.size());
  for (const std::string_view cell : cells_of(line)) {
    const auto found = std::find(format.columns.begin(), format.columns.end(), cell);
    if (found == format.columns.end()) return unknown_column(place, cell, line, format.mend);
    const auto column = static_cast<std::size_t>(found - format.columns.begin());
    if (seen[column]) return place.say(fmt::format("column {} is named twice; {}", quoted(cell), format.mend));
    seen[column] = true;
    columns.push_back(column);
  }
  bool any = false;
  for (std::size_t column = format.needed; column < format.together; ++column) any = any || seen[column];
  for (std::size_t column = 0; column < (any ? format.together : format.needed); ++column) {
    if (!seen[column]) return place.say(fmt::format("column '{}' is missing; {}", format.columns[column], format.mend));
  }
  return {};
}

}  // namespace

std::string read_csv_table(std::string_view text, std::string_view name, const CsvFormat& format,
                           const std::function<std::string(const CsvRow&)>& take) {
  skip_byte_order_mark(text);
  CsvRow row;
  row.place = {name, 1};
  if (const std::size_t line = binary_line(text); line != 0) {
    return CsvPlace{name, line}.say(fmt::format("a control character: this is no CSV text file; {}", format.mend));
  }
  for (; !text.empty(); ++row.place.line) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#') continue;
    std::string error;
    if (row.columns.empty()) {
      error = read_names(row.place, line, format, row.columns);
    } else {
      row.cells = cells_of(line);
      error = row.cells.size() == row.columns.size()
                  ? take(row)
                  : row.place.say(
                        fmt::format("{} columns where the first line names {}", row.cells.size(), row.columns.size()));
    }
    if (!error.empty()) return error;
  }
  return row.columns.empty() ? fmt::format("{}: the file is empty; {}", name, format.mend) : std::string();
}

std::optional<double> finite_cell(const CsvRow& row, std::size_t cell, const CsvFormat& format, std::string& error) {
  const std::optional<double> value = parse_finite(row.cells[cell]);
  if (!value) {
    error = row.place.say(fmt::format("column {}: {} is not a finite number; write it like -12.345",
                                      format.columns[row.columns[cell]], quoted(row.cells[cell])));
  }
  return value;
}

}  // namespace bladefit
