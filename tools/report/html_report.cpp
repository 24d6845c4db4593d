#include "tools/report/html_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/report/blade_map.hpp"
#include "tools/report/chord_table.hpp"
#include "tools/report/defect_table.hpp"
#include "tools/report/findings.hpp"
#include "tools/report/histogram.hpp"
#include "tools/report/html_tables.hpp"
#include "tools/report/identity_table.hpp"
#include "tools/report/report_style.hpp"
#include "tools/report/report_text.hpp"
#include "tools/report/section_views.hpp"
#include "tools/report/side_views.hpp"
#include "tools/report/spread_map.hpp"
#include "tools/report/statements.hpp"
#include "tools/report/tolerance_scale.hpp"
#include "tools/report/zone_table.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kMostDefects = 200;

const char* style_of(BladeState state) {
  if (state == BladeState::out_of_tolerance) return "bad";
  return state == BladeState::in_tolerance ? "good" : "open";
}

std::string head(const Result& result) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Blade inspection: {}</title>\n<style>{}</style>\n</head>\n",
      escaped(result.name), report_style(result));
}

std::string verdict_box(const Result& result) {
  std::string reasons;
  for (const VerdictReason& reason : result.verdict.reasons)
    reasons += fmt::format("<small>{}: {}</small>", readable(word_of(reason.code)), escaped(reason.text));
  return fmt::format("<p class=\"headline {}\">{}{}</p>\n", style_of(result.verdict.state), escaped(headline(result)),
                     reasons);
}

std::string sentence_list(const std::vector<std::string>& sentences) {
  std::string html = "<ul>\n";
  for (const std::string& sentence : sentences) html += fmt::format("<li>{}</li>\n", escaped(sentence));
  return html + "</ul>\n";
}

std::string note_of(const std::string& text) {
  return text.empty() ? text : fmt::format("<p class=\"note\">{}</p>\n", escaped(text));
}

std::string section(const char* title, const std::string& content) {
  return content.empty() ? content : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", title, content);
}

/// A section that begins on a page of its own where it is printed.
std::string page(const char* title, const std::string& content) {
  return content.empty() ? content
                         : fmt::format("<section class=\"page\">\n<h2>{}</h2>\n{}</section>\n", title, content);
}

std::string listed(const std::vector<std::string>& sentences) {
  return sentences.empty() ? "" : sentence_list(sentences);
}

/// How many rows of defects the first page has room for, with the map below them: what verdict and identity take is
/// gone.
std::size_t defects_on_first_page(const Result& result) {
  constexpr std::size_t kRows = 13, kLeast = 3, kMost = 8, kHeadline = 80, kLine = 110;
  std::size_t taken = identity_rows(result) + headline(result).size() / kHeadline;
  for (const VerdictReason& reason : result.verdict.reasons) taken += 1 + reason.text.size() / kLine;
  return std::clamp(kRows - std::min(taken, kRows), kLeast, kMost);
}

}  // namespace

std::string html_report(const Result& result) {
  const ColourScale scale = colour_scale_of(result);
  const ToleranceScale shares = tolerance_scale_of(result);
  const DrawnPoints drawn = drawn_points_of(result, shares);
  const std::string spread = spread_map(result, shares, drawn);
  const std::size_t first_defects = defects_on_first_page(result);
  std::string html = head(result) + "<body>\n<h1>Blade inspection report</h1>\n" + verdict_box(result);
  html += identity_table(result);
  html += section("Defects", defect_table(result, 0, first_defects));
  html += section("Map of the blade", spread.empty() ? "" : spread);
  html += note_of(thinned_note(result, drawn));
  html += page("Pressure and suction side", side_views(result, shares, drawn));
  html += section("Leading edge at the measured radii", section_views(result, shares));
  html += section("Distances by radius and chord", chord_tables(result));
  html += section("What was found", sentence_list(summary_sentences(result)));
  html += section("Certificate", listed(certificate_sentences(result)));
  html += section("Uncertainty and decision", sentence_list(decision_sentences(result)));
  html += section("Lost or not judged", sentence_list(omission_sentences(result)));
  html += section("Zones", zone_table(result));
  html += section("Regions", region_table(result));
  html += section("Pose", pose_table(result));
  html += section("More defects", defect_table(result, first_defects, kMostDefects));
  html += section("Points out of tolerance", out_table(result));
  html += section("Distances", distance_histogram(result, scale));
  html += section("Map in the parameters of the patches", blade_map(result, scale, drawn));
  if (spread.empty()) html += section("Leading edge, magnified", leading_edge_map(result, scale, drawn));
  html += section("Settings", settings_table(result));
  html += section("Files", files_table(result));
  return html + "</body>\n</html>\n";
}

}  // namespace bladefit
