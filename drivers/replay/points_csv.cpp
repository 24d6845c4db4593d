#include "drivers/replay/points_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "drivers/source/direction.hpp"
#include "drivers/text/csv_cells.hpp"
#include "drivers/text/csv_table.hpp"
#include "drivers/text/read_file.hpp"
#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 8> kColumns = {"x", "y", "z", "i", "j", "k", "path", "weight"};
constexpr std::size_t kDirection = 3, kPathColumn = 6, kWeightColumn = 7;
constexpr std::size_t kMaxFileSize = std::size_t{1} << 27U;
/// Beyond these no measured point can be: a coordinate [mm], a weight and its inverse.
constexpr double kLargestCoordinate = 1e9, kLargestWeight = 1e9;
constexpr std::string_view kHeaderFix =
    "the first line must name the columns x,y,z[,i,j,k][,path][,weight], or --columns";

constexpr CsvFormat kFormat{.columns = kColumns,
                            .needed = kDirection,
                            .together = kPathColumn,
                            .first_length = 0,
                            .lengths = kDirection,
                            .fix = kHeaderFix};

Failure parse_path(const CsvRow& row, ProbePoint& point) {
  const std::string_view cell = row.values[kPathColumn];
  if (cell.empty()) return {};
  const std::optional<std::uint16_t> path = parse_whole<std::uint16_t>(cell);
  if (!path)
    return bad_input(row.place.say(fmt::format("column path: {} is not a whole number 0..65535", in_quotes(cell))));
  point.path = *path;
  return {};
}

Failure parse_weight(const CsvRow& row, ProbePoint& point) {
  const std::string_view cell = row.values[kWeightColumn];
  if (cell.empty()) return {};
  if (Failure failure = finite_cell(row, kWeightColumn, kFormat, point.weight)) return failure;
  if (point.weight >= 1 / kLargestWeight && point.weight <= kLargestWeight) return {};
  return bad_input(
      row.place.say(fmt::format("column weight: {} is not a number from {:g} to {:g}; leave points out by --subset",
                                in_quotes(cell), 1 / kLargestWeight, kLargestWeight)));
}

Failure parse_position(const CsvRow& row, double mm_per_unit, ProbePoint& point) {
  for (std::size_t column = 0; column < kDirection; ++column) {
    double value = 0;
    if (Failure failure = finite_cell(row, column, kFormat, value)) return failure;
    point.position[column] = value * mm_per_unit;
    if (std::abs(point.position[column]) <= kLargestCoordinate) continue;
    return bad_input(row.place.say(fmt::format("column {}: {} is beyond {:g} mm; correct it, or its unit",
                                               kColumns[column], in_quotes(row.values[column]), kLargestCoordinate)));
  }
  return {};
}

/// i,j,k; all three empty where the direction is unknown.
Failure parse_direction(const CsvRow& row, Directions directions, ProbePoint& point) {
  bool any = false;
  for (std::size_t column = kDirection; column < kPathColumn; ++column) any = any || !row.values[column].empty();
  if (!any) return {};
  for (std::size_t column = kDirection; column < kPathColumn; ++column) {
    if (Failure failure = finite_cell(row, column, kFormat, point.approach[column - kDirection])) return failure;
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

Failure parse_point(const CsvRow& row, double mm_per_unit, Directions directions, ProbePoint& point) {
  if (Failure failure = parse_position(row, mm_per_unit, point)) return failure;
  if (Failure failure = parse_direction(row, directions, point)) return failure;
  if (Failure failure = parse_path(row, point)) return failure;
  return parse_weight(row, point);
}

void note_header(const CsvHeader& header, const PointsFormat& format, std::string_view name, PointsFile& file) {
  file.has_approach = header.has[kDirection];
  file.has_path = header.has[kPathColumn];
  if (const std::string note = header.unused_note(); !note.empty())
    file.notes.push_back(fmt::format("{}: {}", name, note));
  if (header.unit && *header.unit != format.unit)
    file.notes.push_back(fmt::format("{}: lengths in {}, as the file says", name, word_of(*header.unit)));
}

std::vector<std::string_view> names_in(std::string_view columns) {
  std::vector<std::string_view> names;
  if (!columns.empty()) static_cast<void>(split_cells(columns, ',', names));
  return names;
}

PointsFile failed(Failure failure) {
  PointsFile file;
  file.error = std::move(failure);
  return file;
}

}  // namespace

Failure check_point_columns(std::string_view columns) {
  constexpr std::string_view kFix =
      "name the columns in their order, x, y and z among them: x,y,z[,i,j,k][,path][,weight], - for one that is not "
      "used";
  CsvFormat format = kFormat;
  format.fix = kFix;
  CsvHeader header;
  if (Failure failure = read_names(names_in(columns), format, header)) return failure;
  for (const std::string& name : header.unused) {
    if (name != "-") return bad_input(fmt::format("{} is not a column; {}", in_quotes(name), kFix));
  }
  return {};
}

PointsFile parse_points_csv(std::string_view text, std::string_view name, const PointsFormat& format) {
  PointsFile file;
  CsvHeader header;
  const auto take = [&](const CsvRow& row) -> Failure {
    if (file.points.empty()) {
      if (Failure failure = choose_unit(header, format.given_unit, format.unit, file.unit))
        return bad_input(fmt::format("{}: {}", name, failure.message));
    }
    if (file.points.size() == std::numeric_limits<std::uint32_t>::max()) {
      return bad_input(row.place.say("too many points"));
    }
    ProbePoint point;
    point.sequence = static_cast<std::uint32_t>(file.points.size() + 1);
    if (Failure failure = parse_point(row, mm_per_unit(file.unit), format.directions, point)) return failure;
    file.points.push_back(point);
    return {};
  };
  if (Failure failure = read_csv_table(text, name, kFormat, names_in(format.columns), header, take))
    return failed(std::move(failure));
  if (file.points.empty()) {
    return failed(bad_input(fmt::format("{}: the list of points is empty; add a line for each point", name)));
  }
  note_header(header, format, name, file);
  return file;
}

PointsFile read_points_csv(const std::string& path, const PointsFormat& format) {
  std::string text;
  if (const Failure failure = read_file(path, kMaxFileSize, text)) {
    return failed({failure.kind, fmt::format("{}: {}", file_name(path), failure.message)});
  }
  return parse_points_csv(text, file_name(path), format);
}

}  // namespace bladefit
