#include "tools/report/csv_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/results/words.hpp"

namespace bladefit {
namespace {

std::string number_or_empty(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

}  // namespace

std::string csv_report(const Result& result) {
  const std::string& units = result.units;
  std::string text = fmt::format(
      "sequence,x_{0},y_{0},z_{0},patch,u,v,kind,region,distance_{0},tolerance_{0},uncertainty_{0},state,action,"
      "expanded_uncertainty_{0},distance_before_{0}\n",
      units);
  const auto length = [&result](double mm) { return result.in_units(mm); };
  for (const ResultPoint& point : result.points) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", point.sequence, length(point.position[0]),
                        length(point.position[1]), length(point.position[2]), point.patch, point.u, point.v,
                        word_of(point.kind), word_of(point.region), length(point.distance),
                        number_or_empty(length(point.tolerance)), number_or_empty(length(point.uncertainty)),
                        word_of(point.state), word_of(point.action), number_or_empty(length(point.expanded)),
                        length(point.before));
  }
  return text;
}

}  // namespace bladefit
