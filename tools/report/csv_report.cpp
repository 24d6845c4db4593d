#include "tools/report/csv_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/report/defect_table.hpp"
#include "tools/results/words.hpp"
#include "tools/results/zone_counts.hpp"

namespace bladefit {
namespace {

std::string number_or_empty(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

/// Where on the blade the foot lies; empty columns where that is not known.
std::string place_columns(const Result& result, std::size_t index) {
  if (!result.drawing) return ",,,";
  constexpr double kPercent = 100;
  const PlacedPoint& place = result.drawing->points[index];
  const double ratio = result.tip_radius > 0 ? place.radius / result.tip_radius : std::nan("");
  return fmt::format("{},{},{},{}", side_text(place.side), result.in_units(place.radius), number_or_empty(ratio),
                     number_or_empty(kPercent * place.chord));
}

/// The name of the zone in quotes, where the result has any.
std::string zone_column(const Result& result, const ResultPoint& point) {
  if (result.zones.empty()) return "";
  std::string quoted;
  for (const char c : zone_name(result, point.zone)) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return ",\"" + quoted + "\"";
}

}  // namespace

std::string csv_report(const Result& result) {
  const std::string& units = result.units;
  std::string text = fmt::format(
      "sequence,x_{0},y_{0},z_{0},patch,u,v,kind,region,distance_{0},tolerance_{0},uncertainty_{0},state,action,"
      "expanded_uncertainty_{0},distance_before_{0},side,radius_{0},r_over_R,chord_percent{1}\n",
      units, result.zones.empty() ? "" : ",zone");
  const auto length = [&result](double mm) { return result.in_units(mm); };
  std::size_t index = 0;
  for (const ResultPoint& point : result.points) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}\n", point.sequence,
                        length(point.position[0]), length(point.position[1]), length(point.position[2]), point.patch,
                        point.u, point.v, word_of(point.kind), word_of(point.region), length(point.distance),
                        number_or_empty(length(point.tolerance)), number_or_empty(length(point.uncertainty)),
                        word_of(point.state), word_of(point.action), number_or_empty(length(point.expanded)),
                        length(point.before), place_columns(result, index++), zone_column(result, point));
  }
  return text;
}

}  // namespace bladefit
