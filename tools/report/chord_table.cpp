#include "tools/report/chord_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/report_text.hpp"
#include "tools/report/tolerance_scale.hpp"

namespace bladefit {
namespace {

std::size_t column_of(double chord) {
  constexpr double kPercent = 100;
  const auto* const nearest = std::ranges::min_element(
      kChordPercents, {}, [chord](double percent) { return std::abs(percent - kPercent * chord); });
  return static_cast<std::size_t>(nearest - kChordPercents.begin());
}

std::string chord_cell(const Result& result, std::ptrdiff_t index) {
  if (index < 0) return "<td></td>";
  const ResultPoint point = result.points[static_cast<std::size_t>(index)];
  const std::string number = LengthText(result).with_sign(point.distance);
  if (point.state == PointState::out)
    return fmt::format("<td><span class=\"ring{}\">{}</span></td>", point.distance < 0 ? " minus" : "", number);
  const bool decided = point.state == PointState::in;
  return decided ? fmt::format("<td>{}</td>", number) : fmt::format("<td class=\"doubt\">{}?</td>", number);
}

std::string side_table(const Result& result, BladeSide side, const char* title) {
  const std::vector<ChordRow> rows = chord_rows(result, side);
  std::string html =
      fmt::format("<div class=\"keep\"><h3>{}, {}</h3>\n<table class=\"chords\">\n<thead><tr><th>r/R</th>", title,
                  escaped(result.units));
  for (const double percent : kChordPercents)
    html += fmt::format("<th>{}{:g} %</th>", percent == 0 ? "LE<br>" : percent == 100 ? "TE<br>" : "", percent);
  html += "</tr></thead>\n<tbody>";
  const std::vector<MeasuredSection>& sections = result.drawing->sections;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    html += fmt::format("<tr><td>{:.3f}</td>", sections[sections.size() - 1 - row].radius / result.tip_radius);
    for (const std::ptrdiff_t index : rows[row]) html += chord_cell(result, index);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::vector<ChordRow> chord_rows(const Result& result, BladeSide side) {
  const BladeDrawing& drawing = *result.drawing;
  const ToleranceScale scale = tolerance_scale_of(result);
  ChordRow blank;
  blank.fill(-1);
  std::vector<ChordRow> rows(drawing.sections.size(), blank);
  std::vector<std::array<double, kChordPercents.size()>> worst(rows.size());
  std::size_t index = 0;
  for (const ResultPoint& point : result.points) {
    const PlacedPoint& place = drawing.points[index];
    const auto which = static_cast<std::ptrdiff_t>(index++);
    if (rows.empty() || place.face != side || point.state == PointState::rejected || std::isnan(place.chord)) continue;
    const std::size_t row = rows.size() - 1 - place.section, column = column_of(place.chord);
    const double share = std::abs(scale.share(point));
    if (rows[row][column] >= 0 && share <= worst[row][column]) continue;
    rows[row][column] = which;
    worst[row][column] = share;
  }
  return rows;
}

std::string chord_tables(const Result& result) {
  if (!result.drawing || !result.drawing->edge_known || result.drawing->sections.empty() || !(result.tip_radius > 0))
    return "";
  std::string html;
  if (result.drawing->sides_known) {
    html = side_table(result, BladeSide::suction, "Suction side") +
           side_table(result, BladeSide::pressure, "Pressure side");
  } else {
    html = side_table(result, BladeSide::unknown, "Both sides (which is which is not known)");
  }
  return html +
         "<p class=\"note\">Each number is the distance of the point farthest off in tolerances of those nearest to "
         "that radius and per cent of the chord; + cut, - weld. Ringed: out of tolerance (full ring cut, dashed ring "
         "weld). With ?: not decided. Blank: not probed.</p>\n";
}

}  // namespace bladefit
