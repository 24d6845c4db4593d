#include "tools/design/loft/blade_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "drivers/text/csv_table.hpp"
#include "tools/design/loft/not_a_knot.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 8> kTableColumns = {"r_over_R", "c_over_D", "P_over_D",    "f_over_c",
                                                           "t_over_c", "t_over_D", "rake_over_D", "skew"};
constexpr std::size_t kTableNeeded = 4, kThicknessOfChord = 4, kThicknessOfDiameter = 5;
constexpr CsvFormat kTableFormat{.columns = kTableColumns,
                                 .needed = kTableNeeded,
                                 .together = 0,
                                 .first_length = kTableColumns.size(),
                                 .lengths = 0,
                                 .fix =
                                     "the first line must name the columns: r_over_R,c_over_D,P_over_D,f_over_c,"
                                     "t_over_c[,skew][,rake_over_D]"};
constexpr std::size_t kLeastRows = 4;
/// What no table of a propeller exceeds: it is a wrong column or a wrong unit.
constexpr double kMostChord = 2, kMostPitch = 10, kMostCamber = 0.2, kMostThickness = 1, kMostSkew = 180, kMostRake = 2;

[[noreturn]] void fail_at(const CsvPlace& place, std::string_view what) { throw ToolError(place.say(what)); }

void check_range(const CsvRow& cells, std::size_t column, double value, double low, double high) {
  if (value >= low && value <= high) return;
  fail_at(cells.place, fmt::format("column {}: {} is out of range; give a number from {} to {}",
                                   kTableColumns.at(column), value, low, high));
}

BladeRow parse_table_row(const CsvRow& cells) {
  std::array<double, kTableColumns.size()> values{};
  for (std::size_t column = 0; column < values.size(); ++column) {
    if (!cells.header->has[column]) continue;
    if (const Failure failure = finite_cell(cells, column, kTableFormat, values.at(column))) throw ToolError(failure);
  }
  const bool of_chord = cells.header->has[kThicknessOfChord];
  if (of_chord == cells.header->has[kThicknessOfDiameter]) {
    fail_at(cells.place, of_chord ? "the columns t_over_c and t_over_D both give the thickness; leave one out"
                                  : "there is no column t_over_c or t_over_D, which give the thickness; add one");
  }
  constexpr double kLeast = 1e-6;
  constexpr std::array<std::pair<double, double>, kTableColumns.size()> kRanges = {{{kLeast, 1},
                                                                                    {kLeast, kMostChord},
                                                                                    {-kMostPitch, kMostPitch},
                                                                                    {-kMostCamber, kMostCamber},
                                                                                    {0, kMostThickness},
                                                                                    {0, kMostThickness},
                                                                                    {-kMostRake, kMostRake},
                                                                                    {-kMostSkew, kMostSkew}}};
  for (std::size_t column = 0; column < values.size(); ++column)
    check_range(cells, column, values.at(column), kRanges.at(column).first, kRanges.at(column).second);
  const double thickness = of_chord ? values[kThicknessOfChord] : values[kThicknessOfDiameter] / values[1];
  return {values[0], values[1], values[2], values[7], values[6], values[3], thickness};
}

NotAKnotSpline spline_of(const BladeTable& table, double BladeRow::*value) {
  std::vector<double> radii, values;
  for (const BladeRow& row : table.rows) {
    radii.push_back(row.radius);
    values.push_back(row.*value);
  }
  return {radii, values};
}

/// A cubic that keeps to the rise and fall of its values (F. N. Fritsch, J. Butland, A Method for Constructing Local
/// Monotone Piecewise Cubic Interpolants, SIAM J. Sci. Stat. Comput. 5, 1984).
class MonotoneCubic {
 public:
  MonotoneCubic(std::vector<double> places, std::vector<double> values)
      : places_(std::move(places)), values_(std::move(values)), slopes_(places_.size()) {
    const std::size_t last = places_.size() - 1;
    for (std::size_t k = 1; k < last; ++k) {
      const double before = secant(k - 1), after = secant(k), h = step(k - 1), next = step(k);
      const double first = 2 * next + h, second = next + 2 * h;
      slopes_[k] = before * after > 0 ? (first + second) / (first / before + second / after) : 0.0;
    }
    slopes_[0] = end_slope(0, 1);
    slopes_[last] = end_slope(last - 1, last - 2);
  }

  [[nodiscard]] double at(double place) const {
    const auto after = std::upper_bound(places_.begin() + 1, places_.end() - 1, place);
    const auto k = static_cast<std::size_t>(after - places_.begin()) - 1;
    const double h = step(k), t = (place - places_[k]) / h, s = 1 - t;
    return s * s * (1 + 2 * t) * values_[k] + t * t * (1 + 2 * s) * values_[k + 1] +
           h * t * s * (s * slopes_[k] - t * slopes_[k + 1]);
  }

 private:
  [[nodiscard]] double step(std::size_t k) const { return places_[k + 1] - places_[k]; }
  [[nodiscard]] double secant(std::size_t k) const { return (values_[k + 1] - values_[k]) / step(k); }
  /// Of the parabola through the three places at an end, as far as it keeps to the first secant.
  [[nodiscard]] double end_slope(std::size_t first, std::size_t second) const {
    const double h = step(first), next = step(second), own = secant(first), other = secant(second);
    const double slope = ((2 * h + next) * own - h * other) / (h + next);
    if (slope * own <= 0) return 0.0;
    return own * other <= 0 && std::abs(slope) > 3 * std::abs(own) ? 3 * own : slope;
  }

  std::vector<double> places_, values_, slopes_;
};

/// Towards a tip that closes the chord falls as the square root of the distance from it.
double root_of(double radius) { return -std::sqrt(std::max(0.0, 1 - radius)); }

MonotoneCubic chord_of_radius(const BladeTable& table) {
  std::vector<double> places, values;
  for (const BladeRow& row : table.rows) {
    places.push_back(root_of(row.radius));
    values.push_back(row.chord);
  }
  return {places, values};
}

/// One section at the radius r of the unit of the design.
BladeSection section_of(const BladeRow& row, const BladeShape& shape) {
  BladeSection section{fmt::format("r/R {:.4f}", row.radius), row.radius, {}, {}};
  const double diameter = shape.diameter, r = 0.5 * row.radius * diameter, chord = row.chord * diameter;
  const double pitch_angle = std::atan2(row.pitch * diameter, 2 * std::numbers::pi * r);
  const double skew_arc = r * row.skew * std::numbers::pi / 180.0;
  const std::size_t half = shape.points / 2;
  for (std::size_t k = 0; k <= 2 * half; ++k) {
    const double turn = std::numbers::pi * static_cast<double>(k) / static_cast<double>(half);
    const double x = 0.5 * (1 + std::cos(turn));  // 1 at the trailing edge, 0 at the leading edge, 1 again
    const double side = k <= half ? -1.0 : 1.0;   // pressure side first
    const double offset =
        chord * (row.camber * mean_line(shape.foil, x) + side * row.thickness * half_thickness(shape.foil, x));
    const double along = chord * (0.5 - x);
    const double forward = -row.rake * diameter - skew_arc * std::tan(pitch_angle) + along * std::sin(pitch_angle) +
                           offset * std::cos(pitch_angle);
    const double angle = (-skew_arc + along * std::cos(pitch_angle) - offset * std::sin(pitch_angle)) / r;
    const double across = -r * std::sin(angle);
    section.points.emplace_back(forward, shape.left_handed ? -across : across, r * std::cos(angle));
  }
  return section;
}

}  // namespace

BladeTable parse_blade_table(std::string_view text, const std::string& name) {
  BladeTable table{name, {}, {}};
  CsvHeader header;
  const auto take = [&table](const CsvRow& cells) -> Failure {
    const BladeRow row = parse_table_row(cells);
    if (!table.rows.empty() && row.radius <= table.rows.back().radius) {
      fail_at(cells.place,
              fmt::format("column r_over_R: {} after {}; write the rows from root to tip, each radius once", row.radius,
                          table.rows.back().radius));
    }
    table.rows.push_back(row);
    return {};
  };
  if (const Failure error = read_csv_table(text, name, kTableFormat, {}, header, take)) throw ToolError(error);
  if (table.rows.size() < kLeastRows) {
    throw ToolError(fmt::format("{}: {} rows are too few for a blade; give at least {} radii", name, table.rows.size(),
                                kLeastRows));
  }
  table.note = header.unused_note();
  return table;
}

BladeSections sections_of(const BladeTable& table, const BladeShape& shape) {
  BladeSections blade;
  blade.file = table.file;
  blade.note = table.note;
  const MonotoneCubic chord = chord_of_radius(table);
  const NotAKnotSpline pitch = spline_of(table, &BladeRow::pitch), skew = spline_of(table, &BladeRow::skew),
                       rake = spline_of(table, &BladeRow::rake), camber = spline_of(table, &BladeRow::camber),
                       thickness = spline_of(table, &BladeRow::thickness);
  const double first = root_of(table.rows.front().radius), last = root_of(table.rows.back().radius);
  for (std::size_t k = 0; k < shape.sections; ++k) {
    // Sections are as dense as the chord changes: evenly in the square root of the distance from the tip.
    const double root = first + (last - first) * static_cast<double>(k) / static_cast<double>(shape.sections - 1);
    const double radius = 1 - root * root;
    blade.sections.push_back(section_of({radius, chord.at(root), pitch.at(radius), skew.at(radius), rake.at(radius),
                                         camber.at(radius), thickness.at(radius)},
                                        shape));
  }
  return blade;
}

}  // namespace bladefit
