#include "tools/report/html_report.hpp"

#include <fmt/format.h>

#include "tools/report/blade_map.hpp"
#include "tools/report/findings.hpp"
#include "tools/report/histogram.hpp"
#include "tools/report/html_tables.hpp"
#include "tools/report/report_text.hpp"

namespace bladefit {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 "Segoe UI", "Helvetica Neue", Arial, "Liberation Sans", sans-serif; color: #1a1d21;
  max-width: 1120px; margin: 24px auto; padding: 0 20px; }
h1 { font-size: 22px; margin: 0; } h2 { font-size: 17px; margin: 30px 0 8px; }
.session { color: #565c64; margin: 2px 0 14px; }
.headline { font-size: 19px; font-weight: 600; padding: 11px 16px; border-left: 8px solid; margin: 0 0 12px; }
.bad { background: #fdeee0; border-color: #b34700; } .good { background: #e8f1f9; border-color: #084081; }
.open { background: #f1f1f1; border-color: #777; }
ul { margin: 0; padding-left: 20px; } li { margin: 3px 0; }
table { border-collapse: collapse; width: 100%; font-size: 13.5px; font-variant-numeric: tabular-nums; }
th { text-align: right; font-weight: 600; vertical-align: bottom; border-bottom: 1.5px solid #555; padding: 4px 8px; }
td { text-align: right; border-bottom: 1px solid #dcdfe3; padding: 3px 8px; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
.points { font-size: 12.5px; } .points th, .points td { padding: 3px 5px; }
.points th:nth-child(2), .points td:nth-child(2), .points th:nth-child(7), .points td:nth-child(7) { text-align: left; }
.cut { color: #a04000; } .weld { color: #084081; } .note { color: #565c64; font-size: 13px; margin: 6px 0; }
svg { width: 100%; height: auto; display: block; } svg text { font-family: inherit; fill: #1a1d21; }
.blade { fill: #f3f4f6; stroke: #555; } .edge { fill: #e9e4d0; stroke: #857b50; stroke-dasharray: 5 3; }
.grid { stroke: #b4b9bf; stroke-width: 0.6; fill: none; } .frame { stroke: #555; fill: none; }
.tick { font-size: 12px; } .axis { font-size: 13.5px; font-weight: 600; }
.number { font-size: 11.5px; font-weight: 600; paint-order: stroke; stroke: #fff; stroke-width: 3px; }
.in { stroke: #6d737a; stroke-width: 0.5; } .out { stroke: #000; stroke-width: 1.6; }
.pending { fill: none; stroke: #555; stroke-dasharray: 2 1.5; } .rejected { stroke: #777; fill: none; }
.bar { stroke: #6d737a; stroke-width: 0.6; } .limit { stroke: #000; stroke-dasharray: 5 3; fill: none; }
@page { size: A4 landscape; margin: 12mm; }
@media print { body { margin: 0; max-width: none; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  svg, tr { break-inside: avoid; } h2 { break-after: avoid; } thead { display: table-header-group; } }
)";

const char* style_of(BladeState state) {
  if (state == BladeState::out_of_tolerance) return "bad";
  return state == BladeState::in_tolerance ? "good" : "open";
}

std::string head(const Result& result) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Blade inspection: {}</title>\n<style>{}</style>\n</head>\n",
      escaped(result.name), kStyle);
}

/// Where the points come from, and for a session what they were judged by.
std::string origin(const Result& result) {
  if (!result.identity) return "Points " + escaped(result.name);
  return fmt::format("Session {} &middot; design image {:08x} &middot; settings {:016x}", escaped(result.name),
                     result.identity->design_crc, result.identity->config_digest);
}

std::string summary(const Result& result) {
  std::string html =
      fmt::format("<p class=\"headline {}\">{}</p>\n<ul>\n", style_of(result.verdict.state), escaped(headline(result)));
  for (const std::string& sentence : summary_sentences(result)) html += fmt::format("<li>{}</li>\n", escaped(sentence));
  return html + "</ul>\n";
}

std::string section(const char* title, const std::string& content) {
  return content.empty() ? content : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", title, content);
}

}  // namespace

std::string html_report(const Result& result) {
  const ColourScale scale = colour_scale_of(result);
  std::string html = head(result);
  html += fmt::format("<body>\n<h1>Blade inspection report</h1>\n<p class=\"session\">{}</p>\n", origin(result));
  html += summary(result);
  html += section("Map of the unrolled blade", blade_map(result, scale));
  html += section("Leading edge, magnified", leading_edge_map(result, scale));
  html += section("Points out of tolerance", out_table(result));
  html += section("Regions", region_table(result));
  html += section("Pose", pose_table(result));
  html += section("Distances", distance_histogram(result, scale));
  return html + "<p class=\"note\">Written by bladefit.</p>\n</body>\n</html>\n";
}

}  // namespace bladefit
