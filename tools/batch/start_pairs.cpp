#include "tools/batch/start_pairs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <vector>

#include "drivers/text/csv_table.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 7> kColumns = {"x", "y", "z", "design_x", "design_y", "design_z", "name"};
constexpr std::size_t kNameColumn = 6;
constexpr std::string_view kMend = "the first line must name the columns: [name,]x,y,z,design_x,design_y,design_z";
constexpr CsvFormat kFormat{kColumns, kNameColumn, 0, kMend};
/// Points whose second extent is below this share of the first stand in one line.
constexpr double kInLine = 1e-3;

struct Pair {
  std::array<double, 6> numbers{};
  std::string name;
};

using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;

Pair parse_pair(const CsvRow& row) {
  Pair pair;
  pair.name = fmt::format("line {}", row.place.line);
  for (std::size_t k = 0; k < row.cells.size(); ++k) {
    if (row.columns[k] == kNameColumn) {
      pair.name = std::string(row.cells[k]);
      continue;
    }
    double value = 0;
    if (const Failure failure = finite_cell(row, k, kFormat, value)) throw ToolError(failure);
    pair.numbers[row.columns[k]] = value;
  }
  return pair;
}

std::vector<Pair> parse_pairs(std::string_view text, const std::string& name) {
  std::vector<Pair> pairs;
  const Failure failure = read_csv_table(text, name, kFormat, [&](const CsvRow& row) {
    pairs.push_back(parse_pair(row));
    return Failure();
  });
  if (failure) throw ToolError(failure);
  return pairs;
}

/// Three points or more that span a plane at least fix all six degrees of freedom.
void check_spread(const Points& points, const char* what, const std::string& path) {
  const Points centred = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d extents = Eigen::JacobiSVD<Eigen::Matrix3d>(centred * centred.transpose()).singularValues();
  if (extents[1] > kInLine * kInLine * extents[0]) return;
  throw ToolError(
      fmt::format("{}: the {} points stand in one line, which leaves the turn about it open; add a pair "
                  "away from the line",
                  path, what));
}

}  // namespace

StartPairs read_start_pairs(const std::string& path, double mm_per_unit) {
  const std::vector<Pair> pairs = parse_pairs(read_text(path, "start pairs"), path);
  if (pairs.size() < 3)
    throw ToolError(fmt::format("{}: {} pairs, at least 3 are needed; add a line for each pair", path, pairs.size()));
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
