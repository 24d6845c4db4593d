#include "tools/report/zone_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "tools/report/report_text.hpp"
#include "tools/results/zone_counts.hpp"

namespace bladefit {
namespace {

std::string zone_cells(const std::vector<std::string>& texts, const char* tag) {
  std::string row;
  for (const std::string& text : texts) row += fmt::format("<{0}>{1}</{0}>", tag, text);
  return "<tr>" + row + "</tr>\n";
}

std::string zone_row(const Result& result, const ResultZone& zone, const ZoneCounts& points) {
  const LengthText text(result);
  const auto limit = [&text](const char* sign, double mm) {
    return std::isfinite(mm) ? sign + text.plain(mm) : std::string("not judged");
  };
  const bool any = points.points > 0;
  return zone_cells({escaped(zone.name), escaped(zone.where), limit("+", zone.plus), limit("&minus;", zone.minus),
                     fmt::format("{}", points.points), fmt::format("{}", points.in), fmt::format("{}", points.cut),
                     fmt::format("{}", points.weld), fmt::format("{}", points.beyond), fmt::format("{}", points.open),
                     any ? text.with_sign(points.least) : "-", any ? text.with_sign(points.most) : "-"},
                    "td");
}

}  // namespace

std::string zone_table(const Result& result) {
  const std::vector<ResultZone> zones = zones_and_rest(result);
  if (zones.empty()) return "";
  const std::vector<ZoneCounts> counts = zone_counts(result);
  const std::string unit = ", " + escaped(result.units);
  std::string html = "<table class=\"regions\">\n<thead>";
  html += zone_cells({"Zone", "Where", "Plus" + unit, "Minus" + unit, "Points", "In", "To cut", "To weld",
                      "Beyond the edge", "Not decided", "Least" + unit, "Most" + unit},
                     "th");
  html += "</thead>\n<tbody>";
  for (std::size_t k = 0; k < zones.size(); ++k) html += zone_row(result, zones[k], counts[k]);
  return html +
         "</tbody>\n</table>\n<p class=\"note\">A point is judged by the first zone that its foot lies in.</p>\n";
}

}  // namespace bladefit
