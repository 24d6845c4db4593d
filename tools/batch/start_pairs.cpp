#include "tools/batch/start_pairs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "config/toml_error.hpp"
#include "core/algebra/symmetric_eigen.hpp"
#include "drivers/text/csv_table.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 7> kColumns = {"x", "y", "z", "design_x", "design_y", "design_z", "name"};
constexpr std::size_t kNameColumn = 6;
constexpr std::string_view kFix = "the first line must name the columns: [name,]x,y,z,design_x,design_y,design_z";
constexpr CsvFormat kFormat{
    .columns = kColumns, .needed = kNameColumn, .together = 0, .first_length = 0, .lengths = kNameColumn, .fix = kFix};
/// No place on a machine is farther away, whatever the unit.
constexpr double kLargestCoordinate = 1e9;
/// Pairs whose rests are this share of their spread, in root mean squares, do not belong together: marks are picked to
/// some hundredths of a blade.
constexpr double kWorstRest = 0.05;
/// Pairs that a message lists.
constexpr std::size_t kListed = 3;
/// A pair whose name is longer [bytes] is told by its line.
constexpr std::size_t kLongestName = 20;
/// Points whose second extent is below this share of the first stand in one line.
constexpr double kInLine = 1e-3;

struct Pair {
  std::array<double, 6> numbers{};
  std::string name;
};

using Points = std::vector<Vec3>;

Pair parse_pair(const CsvRow& row) {
  Pair pair;
  pair.name = fmt::format("line {}", row.place.line);
  const std::string_view name = row.values[kNameColumn];
  if (!name.empty() && name.size() <= kLongestName) pair.name = excerpt(name);
  for (std::size_t k = 0; k < kNameColumn; ++k) {
    if (const Failure failure = finite_cell(row, k, kFormat, pair.numbers[k])) throw ToolError(failure);
    if (std::abs(pair.numbers[k]) <= kLargestCoordinate) continue;
    throw ToolError(row.place.say(fmt::format("column {}: {} is beyond {:g}; correct it", kColumns[k],
                                              in_quotes(row.values[k]), kLargestCoordinate)));
  }
  return pair;
}

std::vector<Pair> parse_pairs(std::string_view text, const std::string& name, CsvHeader& header) {
  std::vector<Pair> pairs;
  const Failure failure = read_csv_table(text, name, kFormat, {}, header, [&](const CsvRow& row) {
    pairs.push_back(parse_pair(row));
    return Failure();
  });
  if (failure) throw ToolError(failure);
  return pairs;
}

Vec3 middle_of(const Points& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Sum of (a - middle of a) (b - middle of b)^T.
Mat3 products_of(const Points& a, const Points& b) {
  const Vec3 middle_a = middle_of(a), middle_b = middle_of(b);
  Mat3 sum = Mat3::Zero();
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - middle_a) * (b[k] - middle_b).transpose();
  return sum;
}

/// Three points or more that span a plane at least fix all six degrees of freedom.
void check_spread(const Points& points, const char* what, const std::string& path) {
  Mat6 squares = Mat6::Zero();
  squares.topLeftCorner<3, 3>() = products_of(points, points);
  const Vec6 extents = symmetric_eigen(squares).values;
  if (extents[4] > kInLine * kInLine * extents[5]) return;
  throw ToolError(
      fmt::format("{}: the {} points stand in one line, which leaves the turn about it open; add a pair "
                  "away from the line",
                  path, what));
}

/// The rigid motion that brings the measured points nearest to their places, in root mean squares: its quaternion is
/// the eigenvector of the greatest eigenvalue (Horn 1987).
Pose motion_between(const Points& measured, const Points& design) {
  const Mat3 s = products_of(measured, design);
  Mat6 form = -(2.0 * s.norm() + 1.0) * Mat6::Identity();  // below all eigenvalues of the first four rows
  form.topLeftCorner<4, 4>() << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),
      s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),  //
      s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),  //
      s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
  const Vec6 q = symmetric_eigen(form).vectors.col(5);
  Pose pose;
  // Through its Euler angles the rotation is orthogonal to rounding.
  pose.rotation = rotation_of(euler_angles(Mat3(Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix())));
  pose.translation = middle_of(design) - pose.rotation * middle_of(measured);
  return pose;
}

/// What remains between each measured point and its place.
std::vector<double> rests_of(const Pose& pose, const Points& measured, const Points& design) {
  std::vector<double> rests;
  for (std::size_t k = 0; k < measured.size(); ++k) rests.push_back((apply(pose, measured[k]) - design[k]).norm());
  return rests;
}

double spread_of(const Points& points) {
  return std::sqrt(products_of(points, points).trace() / static_cast<double>(points.size()));
}

/// Pairs that no rigid motion brings together are no start.
void check_rests(const std::vector<Pair>& pairs, const std::vector<double>& rests, double rms_mm, double spread_mm,
                 double mm_per_unit, const std::string& path) {
  if (rms_mm <= kWorstRest * spread_mm) return;
  std::string list;
  for (std::size_t k = 0; k < std::min(pairs.size(), kListed); ++k)
    list += fmt::format("{}{} {:.4g}", k == 0 ? "" : ", ", pairs[k].name, rests[k] / mm_per_unit);
  throw ToolError(fmt::format(
      "{}: the pairs do not fit each other: no rigid motion brings them nearer than rms {:.4g} (their spread is "
      "{:.4g}); what remains: {}{}; check which point belongs to which, and units and signs",
      path, rms_mm / mm_per_unit, spread_mm / mm_per_unit, list,
      pairs.size() > kListed ? fmt::format(" and {} more", pairs.size() - kListed) : ""));
}

}  // namespace

StartPairs read_start_pairs(const std::string& path, const PointsFormat& format) {
  CsvHeader header;
  const std::vector<Pair> pairs = parse_pairs(read_text(path, "start pairs"), path, header);
  Unit unit = format.unit;
  if (const Failure failure = choose_unit(header, format.given_unit, format.unit, unit))
    throw ToolError(fmt::format("{}: {}", path, failure.message));
  const double mm = mm_per_unit(unit);
  if (pairs.size() < 3)
    throw ToolError(fmt::format("{}: {} pairs, at least 3 are needed; add a line for each pair", path, pairs.size()));
  Points measured, design;
  for (const Pair& pair : pairs) {
    measured.push_back(mm * Vec3(pair.numbers.data()));
    design.push_back(mm * Vec3(pair.numbers.data() + 3));
  }
  check_spread(measured, "measured", path);
  check_spread(design, "design", path);
  StartPairs out;
  out.count = pairs.size();
  out.note = header.unused_note();
  out.pose = motion_between(measured, design);
  const std::vector<double> rests = rests_of(out.pose, measured, design);
  const auto worst = std::max_element(rests.begin(), rests.end());
  out.worst_mm = *worst;
  out.worst_name = pairs[static_cast<std::size_t>(worst - rests.begin())].name;
  double square = 0.0;
  for (const double rest : rests) square += rest * rest;
  out.rms_mm = std::sqrt(square / static_cast<double>(pairs.size()));
  check_rests(pairs, rests, out.rms_mm, spread_of(design), mm, path);
  return out;
}

}  // namespace bladefit
