#include "tools/simulate/points_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {
namespace {

constexpr std::array<std::string_view, 7> kColumnNames = {"x", "y", "z", "i", "j", "k", "path"};
constexpr std::size_t kPathColumn = 6;
constexpr double kUnitVectorTolerance = 1e-3;

/// Where the reader stands, to name it in an error.
struct Place {
  const std::string& file;
  std::size_t line = 0;
};

[[noreturn]] void refuse(const Place& place, std::string_view reason) {
  throw ToolError(fmt::format("{}:{}: {}", place.file, place.line, reason));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// Meaning of each field of a line: an index into kColumnNames.
std::vector<std::size_t> read_header(std::string_view line, const Place& place) {
  std::vector<std::size_t> columns;
  for (const std::string_view name : split(line)) {
    const auto* known = std::find(kColumnNames.begin(), kColumnNames.end(), name);
    if (known == kColumnNames.end()) {
      refuse(place,
             "the header is not made of the columns x,y,z[,i,j,k][,path]; give a points file with such a header");
    }
    const auto column = static_cast<std::size_t>(known - kColumnNames.begin());
    if (std::count(columns.begin(), columns.end(), column) != 0) {
      refuse(place, fmt::format("column {} is there twice; remove one", name));
    }
    columns.push_back(column);
  }
  const auto count = [&](std::size_t first, std::size_t last) {
    return std::count_if(columns.begin(), columns.end(), [&](std::size_t c) { return c >= first && c <= last; });
  };
  if (count(0, 2) != 3) refuse(place, "one of the columns x, y, z is missing; add it");
  if (count(3, 5) != 0 && count(3, 5) != 3)
    refuse(place, "the columns i, j, k belong together; give all three or none");
  return columns;
}

MachinePoint make_point(const std::array<double, kColumnNames.size()>& values, double mm_per_unit, const Place& place) {
  MachinePoint point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    point.position_mm[axis] = values[axis] * mm_per_unit;
    point.direction[axis] = values[3 + axis];
  }
  const double length = std::hypot(point.direction[0], point.direction[1], point.direction[2]);
  if (length != 0 && std::abs(length - 1) > kUnitVectorTolerance) {
    refuse(place,
           fmt::format("the direction i,j,k has length {:.6g}; give a unit vector, or 0,0,0 for unknown", length));
  }
  const double path = values[kPathColumn];
  if (!(path >= 0 && path <= 65535) || path != std::floor(path)) {
    refuse(place, "path is not a whole number from 0 to 65535; number the scan lines so");
  }
  point.path = static_cast<std::uint16_t>(path);
  return point;
}

MachinePoint read_point(std::string_view line, const std::vector<std::size_t>& columns, double mm_per_unit,
                        const Place& place) {
  const std::vector<std::string_view> fields = split(line);
  if (fields.size() != columns.size()) {
    refuse(place, fmt::format("{} columns where the header has {}; give every column", fields.size(), columns.size()));
  }
  std::array<double, kColumnNames.size()> values{};
  for (std::size_t field = 0; field < fields.size(); ++field) {
    const std::string_view text = fields[field];
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      refuse(place,
             fmt::format("column {} is not a finite number; write one such as -12.5", kColumnNames[columns[field]]));
    }
    values[columns[field]] = value;
  }
  return make_point(values, mm_per_unit, place);
}

}  // namespace

std::vector<MachinePoint> read_points_file(const std::string& path, double mm_per_unit) {
  std::ifstream file(path);
  if (!file) throw ToolError(fmt::format("{}: cannot be read; give an existing points file", path));
  std::optional<std::vector<std::size_t>> columns;
  std::vector<MachinePoint> points;
  Place place{path};
  std::string line;
  while (std::getline(file, line)) {
    ++place.line;
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    if (columns) {
      points.push_back(read_point(text, *columns, mm_per_unit, place));
    } else {
      columns = read_header(text, place);
    }
  }
  if (file.bad()) throw ToolError(fmt::format("{}: cannot be read to its end; give a points file", path));
  if (points.empty()) throw ToolError(fmt::format("{}: no point in the file; give at least one", path));
  return points;
}

}  // namespace bladefit::simulate
