#include "tools/report/html_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/report/findings.hpp"
#include "tools/report/report_text.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kMostRows = 60;
constexpr double kDegreesPerRadian = 57.295779513082320877;

std::string cells(const std::vector<std::string>& texts, const char* tag = "td") {
  std::string row;
  for (const std::string& text : texts) row += fmt::format("<{0}>{1}</{0}>", tag, text);
  return "<tr>" + row + "</tr>\n";
}

std::string region_row(const Result& result, Region region) {
  const bool leading_edge = region == Region::leading_edge;
  const RegionDistances& sums = leading_edge ? result.leading_edge : result.rest;
  const RegionFindings found = findings_of(result, region);
  const double tolerance = judged_tolerance(result, region);
  const LengthText text(result);
  return cells({leading_edge ? "Leading edge" : "Rest of the blade", fmt::format("{}", sums.count),
                !result.zones.empty()      ? "by zone"
                : std::isfinite(tolerance) ? "±" + text.plain(tolerance)
                                           : "not judged",
                text.plain(sums.rms_before), text.plain(sums.rms_after), text.plain(sums.max_after),
                fmt::format("{}", found.cut), fmt::format("{}", found.weld),
                fmt::format("{}", found.pending + found.undecided)});
}

std::string out_row(const Result& result, const ResultPoint& point) {
  const LengthText text(result);
  const bool cut = point.action == Action::cut;
  const std::string action = point.action == Action::none ? "beyond the edge"
                                                          : fmt::format("<b class=\"{0}\">{1} {0}</b>",
                                                                        word_of(point.action), cut ? "+" : "&minus;");
  return cells({fmt::format("{}", point.sequence), action, text.with_sign(point.distance), text.with_sign(point.before),
                text.plain(point.tolerance), text.plain(std::abs(point.distance) - point.tolerance),
                text.plain(point.uncertainty), readable(word_of(point.region)), fmt::format("{}", point.patch),
                fmt::format("{:.4f}", point.u), fmt::format("{:.4f}", point.v),
                fmt::format("{:.2f}", result.in_units(radius_of(result, point))), text.plain(point.position[0]),
                text.plain(point.position[1]), text.plain(point.position[2])});
}

}  // namespace

std::string region_table(const Result& result) {
  const LengthText text(result);
  const std::string unit = ", " + escaped(result.units);
  std::string html = "<table class=\"regions\">\n<thead>";
  html += cells({"Region", "Points in the fit", "Tolerance" + unit, "RMS before" + unit, "RMS after" + unit,
                 "Largest" + unit, "To cut", "To weld", "Not decided"},
                "th");
  html += "</thead>\n<tbody>" + region_row(result, Region::leading_edge) + region_row(result, Region::rest);
  html += cells({"All", fmt::format("{}", result.all.count), "", text.plain(result.all.rms_before),
                 text.plain(result.all.rms_after), text.plain(result.all.max_after), "", "", ""});
  return html + fmt::format(
                    "</tbody></table>\n<p class=\"note\">Unit of length: {}. Before: as the machine gave the points; "
                    "after: moved by the pose below.</p>\n",
                    escaped(result.units));
}

std::string pose_table(const Result& result) {
  const LengthText text(result);
  const EulerAngles euler = euler_angles(result.pose.rotation);
  const std::array<double, 3> angles = {euler.psi, euler.theta, euler.phi};
  std::optional<std::array<double, 6>> uncertainty;
  if (result.covariance) uncertainty = standard_uncertainty_of(*result.covariance);
  std::string html = "<table class=\"regions\">\n<thead>";
  html += cells({"Axis of the design", "Translation, " + escaped(result.units), "Standard uncertainty",
                 "Rotation about the axis, rad", "the same in degrees", "Standard uncertainty, rad"},
                "th") +
          "</thead>\n<tbody>";
  constexpr std::array<const char*, 3> kTranslations = {"x (tx, psi)", "y (ty, theta)", "z (tz, phi)"};
  for (std::size_t k = 0; k < 3; ++k) {
    html += cells({kTranslations.at(k),
                   fmt::format("{:+.6f}", result.in_units(result.pose.translation[static_cast<Eigen::Index>(k)])),
                   uncertainty ? text.plain(uncertainty->at(3 + k)) : "not determined",
                   fmt::format("{:+.8f}", angles.at(k)), fmt::format("{:+.6f}", angles.at(k) * kDegreesPerRadian),
                   uncertainty ? fmt::format("{:.2e}", uncertainty->at(k)) : "not determined"});
  }
  return html +
         "</tbody></table>\n<p class=\"note\">A measured point R lies at r = C R + t on the design, C = Rx(psi) "
         "Ry(theta) Rz(phi).</p>\n";
}

std::string out_table(const Result& result) {
  const std::vector<ResultPoint> out = out_of_tolerance(result);
  if (out.empty()) return "<p>No point is out of tolerance.</p>\n";
  const std::string unit = ", " + escaped(result.units);
  std::string html = "<table class=\"points\">\n<thead>";
  html += cells({"Point", "Action", "Distance" + unit, "Unfitted" + unit, "Allowed" + unit, "Beyond by" + unit,
                 "Standard uncertainty" + unit, "Region", "Patch", "u", "v", "Radius" + unit, "x measured" + unit,
                 "y measured" + unit, "z measured" + unit},
                "th") +
          "</thead>\n<tbody>";
  for (std::size_t k = 0; k < std::min(out.size(), kMostRows); ++k) html += out_row(result, out[k]);
  html += "</tbody></table>\n";
  if (out.size() > kMostRows)
    html += fmt::format("<p>And {} more: the csv report lists them all.</p>\n", out.size() - kMostRows);
  return html +
         fmt::format(
             "<p class=\"note\">Unit of length: {}. Distance: how far the point lies outside the design surface "
             "(+, cut) or inside it (-, weld). Unfitted: the same before the fit, as the machine gave the point; "
             "a best fit hides errors. Uncertainty: standard uncertainty of the distance that comes from "
             "the fit. Radius: about the x axis of the design.</p>\n",
             escaped(result.units));
}

}  // namespace bladefit
