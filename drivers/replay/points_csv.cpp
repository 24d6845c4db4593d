#include "drivers/replay/points_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>

#include "drivers/source/direction.hpp"
#include "drivers/text/csv_table.hpp"
#include "drivers/text/read_file.hpp"
#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 8> kColumns = {"x", "y", "z", "i", "j", "k", "path", "weight"};
constexpr std::size_t kPathColumn = 6, kWeightColumn = 7;
constexpr std::size_t kMaxFileSize = std::size_t{1} << 30U;
constexpr std::string_view kHeaderFix = "the first line must name the columns: x,y,z[,i,j,k][,path][,weight]";

constexpr CsvFormat kFormat{kColumns, 3, kPathColumn, kHeaderFix};

Failure parse_path(const CsvPlace& place, std::string_view cell, ProbePoint& point) {
  const std::optional<std::uint16_t> path = parse_whole<std::uint16_t>(cell);
  if (!path) return bad_input(place.say(fmt::format("column path: {} is not a whole number 0..65535", quoted(cell))));
  point.path = *path;
  return {};
}

Failure parse_weight(const CsvPlace& place, std::string_view cell, ProbePoint& point) {
  const std::optional<double> weight = parse_finite(cell);
  if (!weight || !(*weight > 0.0)) {
    return bad_input(place.say(
        fmt::format("column weight: {} is not a number above 0; leave points out by --subset", quoted(cell))));
  }
  point.weight = *weight;
  return {};
}

Failure parse_coordinate(const CsvRow& row, std::size_t cell, double mm_per_unit, ProbePoint& point) {
  double value = 0;
  if (Failure failure = finite_cell(row, cell, kFormat, value)) return failure;
  const std::size_t column = row.columns[cell];
  if (column >= 3) {
    point.approach[column - 3] = value;
    return {};
  }
  point.position[column] = value * mm_per_unit;
  if (std::isfinite(point.position[column])) return {};
  return bad_input(row.place.say(fmt::format("column {}: {} is too large", kColumns[column], quoted(row.cells[cell]))));
}

/// Reads one line of numbers.
Failure parse_point(const CsvRow& row, double mm_per_unit, Directions directions, ProbePoint& point) {
  for (std::size_t cell = 0; cell < row.cells.size(); ++cell) {
    const std::size_t column = row.columns[cell];
    Failure failure = column == kPathColumn     ? parse_path(row.place, row.cells[cell], point)
                      : column == kWeightColumn ? parse_weight(row.place, row.cells[cell], point)
                                                : parse_coordinate(row, cell, mm_per_unit, point);
    if (failure) return failure;
  }
  const double length = length_of(point.approach);
  std::array<double, 3> unit_vector = point.approach;
  if (normalise_direction(unit_vector)) {
    if (directions == Directions::normalised) point.approach = unit_vector;
    return {};
  }
  return bad_input(row.place.say(fmt::format(
      "columns i,j,k: the direction has the length {:.6g}; make it a unit vector, or 0,0,0 where it is unknown",
      length)));
}

PointsFile failed(Failure failure) {
  PointsFile file;
  file.error = std::move(failure);
  return file;
}

}  // namespace

PointsFile parse_points_csv(std::string_view text, std::string_view name, double mm_per_unit, Directions directions) {
  PointsFile file;
  const auto take = [&](const CsvRow& row) -> Failure {
    if (file.points.size() == std::numeric_limits<std::uint32_t>::max()) {
      return bad_input(row.place.say("too many points"));
    }
    ProbePoint point;
    point.sequence = static_cast<std::uint32_t>(file.points.size() + 1);
    if (Failure failure = parse_point(row, mm_per_unit, directions, point)) return failure;
    if (file.points.empty()) {
      for (const std::size_t column : row.columns) {
        file.has_path = file.has_path || column == kPathColumn;
        file.has_approach = file.has_approach || column == 3;
      }
    }
    file.points.push_back(point);
    return {};
  };
  if (Failure failure = read_csv_table(text, name, kFormat, take)) return failed(std::move(failure));
  if (file.points.empty()) {
    return failed(bad_input(fmt::format("{}: the list of points is empty; add a line for each point", name)));
  }
  return file;
}

PointsFile read_points_csv(const std::string& path, double mm_per_unit, Directions directions) {
  std::string text;
  if (const Failure failure = read_file(path, kMaxFileSize, text)) {
    return failed(bad_input(fmt::format("{}: {}; give a readable CSV file of points", path, failure.message)));
  }
  return parse_points_csv(text, path, mm_per_unit, directions);
}

}  // namespace bladefit
