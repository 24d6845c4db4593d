#include "tools/start_pairs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <vector>

#include "drivers/csv_text.hpp"
#include "drivers/text_number.hpp"
#include "tools/design/design_file.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 7> kColumns = {"x", "y", "z", "design_x", "design_y", "design_z", "name"};
constexpr std::size_t kNameColumn = 6;
constexpr std::string_view kMend = "the first line must name the columns: [name,]x,y,z,design_x,design_y,design_z";
/// Points whose second extent is below this share of the first stand in one line.
constexpr double kInLine = 1e-3;

struct Pair {
  std::array<double, 6> numbers{};
  std::string name;
};

using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;

std::vector<std::size_t> parse_header(const CsvPlace& place, std::string_view line) {
  std::array<bool, kColumns.size()> seen{};
  std::vector<std::size_t> header;
  for (const std::string_view cell : cells_of(line)) {
    std::size_t column = 0;
    while (column < kColumns.size() && kColumns[column] != cell) ++column;
    if (column == kColumns.size()) throw DesignError(unknown_column(place, cell, line, kMend));
    if (seen[column]) throw DesignError(place.say(fmt::format("column {} is named twice; {}", quoted(cell), kMend)));
    seen[column] = true;
    header.push_back(column);
  }
  for (std::size_t column = 0; column < kNameColumn; ++column) {
    if (!seen[column]) throw DesignError(place.say(fmt::format("column '{}' is missing; {}", kColumns[column], kMend)));
  }
  return header;
}

Pair parse_pair(const CsvPlace& place, std::string_view line, const std::vector<std::size_t>& header) {
  const std::vector<std::string_view> cells = cells_of(line);
  if (cells.size() != header.size())
    throw DesignError(place.say(fmt::format("{} columns where the first line names {}", cells.size(), header.size())));
  Pair pair;
  pair.name = fmt::format("line {}", place.line);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (header[k] == kNameColumn) {
      pair.name = std::string(cells[k]);
      continue;
    }
    const std::optional<double> value = parse_finite(cells[k]);
    if (!value) {
      throw DesignError(place.say(fmt::format("column {}: {} is not a finite number; write it like -12.345",
                                              kColumns[header[k]], quoted(cells[k]))));
    }
    pair.numbers[header[k]] = *value;
  }
  return pair;
}

std::vector<Pair> parse_pairs(std::string_view text, const std::string& name) {
  skip_byte_order_mark(text);
  std::vector<std::size_t> header;
  std::vector<Pair> pairs;
  for (CsvPlace place{name, 1}; !text.empty(); ++place.line) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#') continue;
    if (header.empty()) {
      header = parse_header(place, line);
    } else {
      pairs.push_back(parse_pair(place, line, header));
    }
  }
  return pairs;
}

/// Three points or more that span a plane at least fix all six degrees of freedom.
void check_spread(const Points& points, const char* what, const std::string& path) {
  const Points centred = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d extents = Eigen::JacobiSVD<Eigen::Matrix3d>(centred * centred.transpose()).singularValues();
  if (extents[1] > kInLine * kInLine * extents[0]) return;
  throw DesignError(
      fmt::format("{}: the {} points stand in one line, which leaves the turn about it open; add a pair "
                  "away from the line",
                  path, what));
}

}  // namespace

StartPairs read_start_pairs(const std::string& path, double mm_per_unit) {
  const std::vector<Pair> pairs = parse_pairs(read_text(path), path);
  if (pairs.size() < 3)
    throw DesignError(fmt::format("{}: {} pairs, at least 3 are needed; add a line for each pair", path, pairs.size()));
  Points measured(3, pairs.size()), design(3, pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(k);
      measured(row, column) = mm_per_unit * pairs[k].numbers[i];
      design(row, column) = mm_per_unit * pairs[k].numbers[3 + i];
    }
  }
  check_spread(measured, "measured", path);
  check_spread(design, "design", path);
  const Eigen::Matrix4d motion = Eigen::umeyama(measured, design, false);
  StartPairs out;
  out.count = pairs.size();
  // Through its Euler angles the rotation is orthogonal to rounding.
  out.pose.rotation = rotation_of(euler_angles(Mat3(motion.topLeftCorner<3, 3>())));
  out.pose.translation = motion.topRightCorner<3, 1>();
  double square = 0.0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const double rest = (apply(out.pose, measured.col(column)) - Vec3(design.col(column))).norm();
    square += rest * rest;
    if (rest < out.worst_mm) continue;
    out.worst_mm = rest;
    out.worst_name = pairs[k].name;
  }
  out.rms_mm = std::sqrt(square / static_cast<double>(pairs.size()));
  return out;
}

}  // namespace bladefit
