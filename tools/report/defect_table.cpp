#include "tools/report/defect_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/report/report_text.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

/// A defect beside the point that is farthest off in it.
std::string defect_row(const Result& result, std::size_t index) {
  const BladeDefect& defect = result.drawing->defects[index];
  const ResultPoint worst = result.points[index_of_sequence(result, defect.sequence)];
  const LengthText text(result);
  const bool cut = defect.action == Action::cut;
  const std::string action = defect.action == Action::none ? "beyond the edge"
                                                           : fmt::format("<b class=\"{0}\">{1} {0}</b>",
                                                                         word_of(defect.action), cut ? "+" : "&minus;");
  const std::string side = side_text(defect.side);
  const std::string place = readable(word_of(defect.region)) + (side.empty() ? "" : ", " + side);
  return fmt::format(
      "<tr><td><b>{}</b></td><td>{:.3f} to "
      "{:.3f}</td><td>{:.2f}</td><td>{}</td><td>{}</td><td><b>{}</b></td><td>{}</td>"
      "<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
      defect_name(index), defect.from_ratio, defect.to_ratio, result.in_units(static_cast<double>(defect.length)),
      place, action, text.with_sign(worst.distance), text.plain(worst.tolerance), defect.points, defect.sequence,
      text.plain(worst.position[0]), text.plain(worst.position[1]), text.plain(worst.position[2]));
}

}  // namespace

std::string defect_name(std::size_t index) { return fmt::format("D{}", index + 1); }

std::string side_text(BladeSide side) {
  switch (side) {
    case BladeSide::suction:
      return "suction";
    case BladeSide::pressure:
      return "pressure";
    case BladeSide::nose:
      return "nose";
    case BladeSide::unknown:
      break;
  }
  return "";
}

std::size_t index_of_sequence(const Result& result, std::uint32_t sequence) {
  std::size_t low = 0, high = result.points.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (result.points[middle].sequence < sequence) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low < result.points.size() && result.points[low].sequence == sequence ? low : result.points.size();
}

std::string defect_table(const Result& result, std::size_t first, std::size_t most) {
  if (!result.drawing) return "";
  const std::size_t count = result.drawing->defects.size();
  if (count == 0) return first == 0 ? "<p>No point is out of tolerance.</p>\n" : "";
  if (first >= count) return "";
  const std::string unit = escaped(result.units);
  std::string html = fmt::format(
      "<table class=\"defects\">\n<thead><tr><th></th><th>r/R</th><th>Length, "
      "{0}</th><th>Where</th><th>Do</th><th>Worst, "
      "{0}</th><th>Allowed, {0}</th><th>Points</th><th>Worst point</th><th>x, {0}</th><th>y, {0}</th><th>z, "
      "{0}</th></tr>"
      "</thead>\n<tbody>",
      unit);
  const std::size_t end = std::min(count, first + most);
  for (std::size_t k = first; k < end; ++k) html += defect_row(result, k);
  html += "</tbody></table>\n";
  if (first > 0) return html;
  if (end < count) html += fmt::format("<p>And {} more below.</p>\n", count - end);
  return html +
         "<p class=\"note\">A defect joins points out of tolerance that lie within 3 % of R of each other, in the same "
         "region and to the same side. x, y, z: where the machine touched its worst point.</p>\n";
}

}  // namespace bladefit
