#include "tools/results/verdicts_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "drivers/text/text_number.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 19> kColumns = {"sequence",
                                                       "patch",
                                                       "u",
                                                       "v",
                                                       "kind",
                                                       "region",
                                                       "distance_mm",
                                                       "tolerance_mm",
                                                       "uncertainty_mm",
                                                       "state",
                                                       "action",
                                                       "x",
                                                       "y",
                                                       "z",
                                                       "expanded_uncertainty_mm",
                                                       "distance_before_mm",
                                                       "left_out",
                                                       "beyond_mm",
                                                       "zone"};
/// The last column is there where a fit has zones: the number of the point's, from 1; 0 = none of them.
constexpr std::size_t kZone = kColumns.size() - 1;

/// One line of the file, cut at its commas.
struct Row {
  const std::string& path;
  std::size_t line = 0;
  std::array<std::string_view, kColumns.size()> cells{};

  [[noreturn]] void refuse(const std::string& what) const {
    throw ToolError(fmt::format("{}:{}: {}; {}", path, line, what, kDamagedFileRemedy));
  }

  [[noreturn]] void refuse_cell(std::size_t column, const char* wanted) const {
    refuse(fmt::format("column {}: '{}' is {}", kColumns[column], cells[column].substr(0, kQuotedCharacters), wanted));
  }

  [[nodiscard]] double finite(std::size_t column) const {
    const std::optional<double> value = parse_finite(cells[column]);
    if (!value) refuse_cell(column, "not a finite number");
    return *value;
  }

  /// A number that is not negative; infinity is allowed.
  [[nodiscard]] double bound(std::size_t column) const {
    if (cells[column] == "inf") return std::numeric_limits<double>::infinity();
    const double value = finite(column);
    if (value < 0) refuse_cell(column, "negative");
    return value;
  }

  [[nodiscard]] double parameter(std::size_t column) const {
    const double value = finite(column);
    if (value < 0 || value > 1) refuse_cell(column, "not within 0 to 1");
    return value;
  }

  [[nodiscard]] std::uint32_t whole(std::size_t column) const {
    const std::optional<std::uint32_t> value = parse_whole<std::uint32_t>(cells[column]);
    if (!value) refuse_cell(column, "not a whole number");
    return *value;
  }

  template <typename Value, std::size_t count>
  [[nodiscard]] Value one_of(std::size_t column, const std::array<std::string_view, count>& words) const {
    const std::optional<Value> value = value_of<Value>(words, cells[column]);
    if (!value) refuse_cell(column, "not a word of this column");
    return *value;
  }
};

Row cut(const std::string& path, std::size_t line, std::string_view text, std::size_t columns) {
  Row row{path, line};
  std::size_t count = 0;
  while (true) {
    const std::size_t comma = text.find(',');
    if (count < row.cells.size()) row.cells.at(count) = text.substr(0, comma);
    ++count;
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (count != columns) row.refuse(fmt::format("{} columns where {} belong", count, columns));
  return row;
}

ResultPoint point_of(const Row& row) {
  ResultPoint point;
  point.sequence = row.whole(0);
  point.patch = row.whole(1);
  point.u = row.parameter(2);
  point.v = row.parameter(3);
  point.kind = row.one_of<FootKind>(4, kKindWords);
  point.region = row.one_of<Region>(5, kRegionWords);
  point.distance = row.finite(6);
  point.tolerance = row.bound(7);
  point.uncertainty = row.bound(8);
  point.state = row.one_of<PointState>(9, kStateWords);
  point.action = row.one_of<Action>(10, kActionWords);
  for (std::size_t axis = 0; axis < 3; ++axis) point.position.at(axis) = row.finite(11 + axis);
  point.expanded = row.bound(14);
  point.before = row.finite(15);
  point.left_out = row.one_of<LeftOut>(16, kLeftOutWords);
  point.beyond = row.bound(17);
  if (row.cells[kZone].empty()) return point;
  const std::uint32_t zone = row.whole(kZone);
  if (zone > ToleranceMap::kMaxZones) row.refuse_cell(kZone, "no number of a zone");
  point.zone = static_cast<std::uint8_t>(zone);
  return point;
}

/// The names of the columns, with that of the zone or without.
std::string heading(std::size_t columns) {
  return fmt::format("{}", fmt::join(kColumns.begin(), kColumns.begin() + static_cast<std::ptrdiff_t>(columns), ","));
}

}  // namespace

std::string verdicts_csv(const Rows<ResultPoint>& points) {
  std::string text;
  write_verdicts_csv(points, [&text](std::string_view piece) { text += piece; });
  return text;
}

void write_verdicts_csv(const Rows<ResultPoint>& points, const Put& put) {
  const bool zoned =
      std::any_of(points.begin(), points.end(), [](const ResultPoint& point) { return point.zone != 0; });
  put(heading(zoned ? kColumns.size() : kZone) + "\n");
  for (const ResultPoint& point : points) {
    put(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", point.sequence, point.patch, point.u,
                    point.v, word_of(point.kind), word_of(point.region), point.distance, point.tolerance,
                    point.uncertainty, word_of(point.state), word_of(point.action), point.position[0],
                    point.position[1], point.position[2], point.expanded, point.before, word_of(point.left_out),
                    point.beyond));
    put(zoned ? fmt::format(",{}\n", point.zone) : "\n");
  }
}

Rows<ResultPoint> parse_verdicts(const std::string& path, std::string_view text) {
  Rows<ResultPoint> points;
  const std::size_t columns = text.substr(0, text.find('\n')) == heading(kColumns.size()) ? kColumns.size() : kZone;
  for (std::size_t line = 1; !text.empty() || line == 1; ++line) {
    const std::size_t end = text.find('\n');
    const Row row = cut(path, line, text.substr(0, end), columns);
    if (end == std::string_view::npos) row.refuse("the line has no end");
    text.remove_prefix(end + 1);
    if (line == 1) {
      if (!std::equal(row.cells.begin(), row.cells.begin() + static_cast<std::ptrdiff_t>(columns), kColumns.begin()))
        row.refuse("these are not the columns of a verdicts.csv");
      continue;
    }
    points.push_back(point_of(row));
    if (points.size() > 1 && points.back().sequence <= points[points.size() - 2].sequence)
      row.refuse("the sequence does not rise");
  }
  return points;
}

}  // namespace bladefit
