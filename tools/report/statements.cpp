#include "tools/report/statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivers/text/text_number.hpp"
#include "tools/report/report_text.hpp"
#include "tools/results/words.hpp"
#include "tools/results/zone_counts.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kRangesNamed = 12;

std::string certificate_points(const Certificate& certificate) {
  std::string text;
  for (std::uint32_t k = 0; k < certificate.count; ++k) {
    text += fmt::format("{}{} ({})",
                        k == 0                       ? ""
                        : k + 1 == certificate.count ? " and "
                                                     : ", ",
                        certificate.sequence.at(k), certificate.sign.at(k) > 0 ? "+" : "-");
  }
  return text;
}

std::size_t points_in(const Result& result, PointState state) {
  return static_cast<std::size_t>(std::count_if(result.points.begin(), result.points.end(),
                                                [state](const ResultPoint& point) { return point.state == state; }));
}

/// Settings that say nothing where they are as they always are, and boxes, which the pictures show.
bool is_told(const std::string& name) {
  return name != "digest" && !name.starts_with("tolerance.boxes") && !name.starts_with("start.");
}

/// A number without the digits of rounding, any other value as it is.
std::string value_text(const std::string& value) {
  const std::optional<double> number = parse_finite(value);
  return number ? fmt::format("{:.12g}", *number) : value;
}

}  // namespace

std::vector<std::string> certificate_sentences(const Result& result) {
  const Certificate& certificate = result.certificate;
  if (certificate.count == 0 || !(result.tolerance_factor > 0)) return {};
  const LengthText text(result);
  std::vector<std::string> sentences;
  const bool infeasible = result.status == word_of(FitStatus::infeasible);
  sentences.push_back(fmt::format(
      "{}: {}. No motion of the blade as a whole brings all of these points nearer together: each push on one is "
      "taken up by the others. They stand as diamonds on the map.",
      infeasible ? "These points prove that the tolerances cannot be met" : "The optimum rests on these points",
      certificate_points(certificate)));
  const ZoneShare share = zone_share(result);
  const std::string value =
      share.factor > 0
          ? fmt::format("The tolerances of the zones and the rest can just be met once all are multiplied by {:.4f}",
                        share.factor)
          : fmt::format("The value of the optimum is {}", text.with_unit(result.tolerance_factor));
  sentences.push_back(fmt::format("{}{}.", value,
                                  result.further_starts > 0
                                      ? fmt::format("; {} of {} further starts led to it, none to a better one",
                                                    result.same_optimum, result.further_starts)
                                      : ""));
  if (infeasible) sentences.emplace_back("What to do: measure these points again, or widen the tolerances.");
  return sentences;
}

std::vector<std::string> decision_sentences(const Result& result) {
  const ResultVerdict& verdict = result.verdict;
  std::vector<std::string> sentences;
  if (verdict.decision == DecisionRule::guarded) {
    sentences.push_back(fmt::format(
        "Guarded decision (ISO 14253-1:2017): a point is in where |distance| + U is within the tolerance, out where "
        "|distance| - U is beyond it, else undecided; U = {:g} u.",
        verdict.coverage_factor));
  } else {
    sentences.push_back(fmt::format(
        "Simple decision: |distance| is compared with the tolerance as it is. A point whose standard uncertainty "
        "reaches a third of its tolerance is not decided. Expanded uncertainties below are U = {:g} u.",
        verdict.coverage_factor));
  }
  double least = 0, most = 0;
  bool any = false;
  for (const ResultPoint& point : result.points) {
    if (point.state == PointState::rejected || !std::isfinite(point.expanded)) continue;
    least = any ? std::min(least, point.expanded) : point.expanded;
    most = std::max(most, point.expanded);
    any = true;
  }
  const LengthText text(result);
  if (any) {
    sentences.push_back(fmt::format(
        "Expanded uncertainty of a distance: {} to {}. It holds what comes from the fit, and from the probe only where "
        "a probe uncertainty or the machine's MPE was given.",
        text.plain(least), text.with_unit(most)));
  }
  return sentences;
}

std::vector<std::string> omission_sentences(const Result& result) {
  std::vector<std::string> sentences;
  const std::vector<SequenceRange>& lost = result.verdict.lost;
  if (!lost.empty()) {
    std::string ranges;
    for (std::size_t k = 0; k < std::min(lost.size(), kRangesNamed); ++k)
      ranges += fmt::format("{}{} to {}", k == 0 ? "" : ", ", lost[k].first, lost[k].last);
    if (lost.size() > kRangesNamed) ranges += fmt::format(" and {} more ranges", lost.size() - kRangesNamed);
    sentences.push_back(
        fmt::format("Records that never arrived: {}. What they would have shown is not known.", ranges));
  }
  const auto tell = [&](PointState state, const char* what) {
    if (const std::size_t count = points_in(result, state); count > 0)
      sentences.push_back(fmt::format("{}: {}", counted(count, "point"), what));
  };
  tell(PointState::rejected, "not judged, the foot is outside the window or on an outer edge of the design.");
  tell(PointState::pending, "not decided, the points do not determine the fit well enough there.");
  tell(PointState::undecided, "undecided, too near to the tolerance for the uncertainty.");
  if (result.drawing && result.drawing->out_not_joined > 0) {
    sentences.push_back(fmt::format("{} out of tolerance beyond the worst are in the csv report, not in the defects.",
                                    counted(result.drawing->out_not_joined, "point")));
  }
  if (sentences.empty()) sentences.emplace_back("Nothing is known to be lost, and every point was judged.");
  if (result.drawing && !result.drawing->edge_known)
    sentences.emplace_back("No leading edge is set: sides, chords and sections are not shown.");
  if (!result.drawing)
    sentences.emplace_back("The session holds no design: pictures of the blade, defects and chords are not shown.");
  return sentences;
}

std::string settings_table(const Result& result) {
  std::vector<std::pair<std::string, std::string>> told;
  for (const auto& setting : result.settings) {
    if (is_told(setting.first)) told.push_back(setting);
  }
  if (told.empty()) return "";
  std::string html = "<table class=\"identity settings\"><tbody>\n";
  for (std::size_t k = 0; k < told.size(); k += 2) {
    html += "<tr>";
    for (const std::size_t i : {k, k + 1}) {
      html += i < told.size()
                  ? fmt::format("<td>{}</td><td>{}</td>", escaped(told[i].first), escaped(value_text(told[i].second)))
                  : "<td></td><td></td>";
    }
    html += "</tr>\n";
  }
  return html +
         "</tbody></table>\n<p class=\"note\">Names that end with _mm are in mm, others without a unit of their "
         "own are counts, ratios or words.</p>\n";
}

}  // namespace bladefit
