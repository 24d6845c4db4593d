#include "drivers/replay/points_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>

#include "drivers/csv_text.hpp"
#include "drivers/direction.hpp"
#include "drivers/read_file.hpp"
#include "drivers/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 8> kColumns = {"x", "y", "z", "i", "j", "k", "path", "weight"};
constexpr std::size_t kPathColumn = 6, kWeightColumn = 7;
constexpr std::size_t kMaxFileSize = std::size_t{1} << 30U;
constexpr std::string_view kHeaderMend = "the first line must name the columns: x,y,z[,i,j,k][,path][,weight]";

/// Column of the file -> index in kColumns.
using Header = std::vector<std::size_t>;

/// Reads the line of column names. Returns the error, empty = none.
std::string parse_header(const CsvPlace& place, std::string_view line, Header& header) {
  std::array<bool, kColumns.size()> seen{};
  for (const std::string_view cell : cells_of(line)) {
    std::size_t column = 0;
    while (column < kColumns.size() && kColumns[column] != cell) ++column;
    if (column == kColumns.size()) return unknown_column(place, cell, line, kHeaderMend);
    if (seen[column]) return place.say(fmt::format("column {} is named twice; {}", quoted(cell), kHeaderMend));
    seen[column] = true;
    header.push_back(column);
  }
  const bool any_direction = seen[3] || seen[4] || seen[5];
  for (std::size_t column = 0; column < kPathColumn; ++column) {
    const bool needed = column < 3 || any_direction;
    if (needed && !seen[column])
      return place.say(fmt::format("column '{}' is missing; {}", kColumns[column], kHeaderMend));
  }
  return {};
}

std::string parse_path(const CsvPlace& place, std::string_view cell, ProbePoint& point) {
  const std::optional<std::uint16_t> path = parse_whole<std::uint16_t>(cell);
  if (!path) return place.say(fmt::format("column path: {} is not a whole number 0..65535", quoted(cell)));
  point.path = *path;
  return {};
}

std::string parse_weight(const CsvPlace& place, std::string_view cell, ProbePoint& point) {
  const std::optional<double> weight = parse_finite(cell);
  if (!weight || !(*weight > 0.0)) {
    return place.say(
        fmt::format("column weight: {} is not a number above 0; leave points out by --subset", quoted(cell)));
  }
  point.weight = *weight;
  return {};
}

std::string parse_coordinate(const CsvPlace& place, std::string_view cell, std::size_t column, double mm_per_unit,
                             ProbePoint& point) {
  const std::optional<double> value = parse_finite(cell);
  const std::string_view name = kColumns[column];
  if (!value)
    return place.say(fmt::format("column {}: {} is not a finite number; write it like -12.345", name, quoted(cell)));
  if (column >= 3) {
    point.approach[column - 3] = *value;
    return {};
  }
  point.position[column] = *value * mm_per_unit;
  if (std::isfinite(point.position[column])) return {};
  return place.say(fmt::format("column {}: {} is too large", name, quoted(cell)));
}

/// Reads one line of numbers. Returns the error, empty = none.
std::string parse_point(const CsvPlace& place, std::string_view line, const Header& header, double mm_per_unit,
                        ProbePoint& point) {
  const std::vector<std::string_view> cells = cells_of(line);
  if (cells.size() != header.size()) {
    return place.say(fmt::format("{} columns where the first line names {}", cells.size(), header.size()));
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    std::string error = header[cell] == kPathColumn ? parse_path(place, cells[cell], point)
                        : header[cell] == kWeightColumn
                            ? parse_weight(place, cells[cell], point)
                            : parse_coordinate(place, cells[cell], header[cell], mm_per_unit, point);
    if (!error.empty()) return error;
  }
  const double length = length_of(point.approach);
  if (normalise_direction(point.approach)) return {};
  return place.say(fmt::format(
      "columns i,j,k: the direction has the length {:.6g}; make it a unit vector, or 0,0,0 where it is unknown",
      length));
}

PointsFile failed(std::string error) {
  PointsFile file;
  file.error = std::move(error);
  return file;
}

}  // namespace

PointsFile parse_points_csv(std::string_view text, std::string_view name, double mm_per_unit) {
  skip_byte_order_mark(text);
  if (const std::size_t line = binary_line(text); line != 0) {
    return failed(
        CsvPlace{name, line}.say("a control character: this is no CSV text file; give a file with the columns x,y,z"));
  }
  PointsFile file;
  Header header;
  for (CsvPlace place{name, 1}; !text.empty(); ++place.line) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#') continue;
    if (header.empty()) {
      if (std::string error = parse_header(place, line, header); !error.empty()) return failed(std::move(error));
      continue;
    }
    if (file.points.size() == std::numeric_limits<std::uint32_t>::max()) return failed(place.say("too many points"));
    ProbePoint point;
    point.sequence = static_cast<std::uint32_t>(file.points.size() + 1);
    if (std::string error = parse_point(place, line, header, mm_per_unit, point); !error.empty()) {
      return failed(std::move(error));
    }
    file.points.push_back(point);
  }
  if (header.empty()) return failed(fmt::format("{}: the file is empty; {}", name, kHeaderMend));
  if (file.points.empty())
    return failed(fmt::format("{}: the list of points is empty; add a line for each point", name));
  for (const std::size_t column : header) {
    file.has_path = file.has_path || column == kPathColumn;
    file.has_approach = file.has_approach || column == 3;
  }
  return file;
}

PointsFile read_points_csv(const std::string& path, double mm_per_unit) {
  std::string text;
  const std::string fault = read_file(path, kMaxFileSize, text);
  if (!fault.empty()) return failed(fmt::format("{}: {}; give a readable CSV file of points", path, fault));
  return parse_points_csv(text, path, mm_per_unit);
}

}  // namespace bladefit
