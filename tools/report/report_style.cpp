#include "tools/report/report_style.hpp"

#include <fmt/format.h>

#include "tools/report/report_text.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

constexpr const char* kScreenStyle = R"(
body { font: 14px/1.4 "Segoe UI", "Helvetica Neue", Arial, "Liberation Sans", sans-serif; color: #1a1d21;
  max-width: 760px; margin: 24px auto; padding: 0 20px; }
h1 { font-size: 22px; margin: 0; } h2 { font-size: 16px; margin: 26px 0 6px; border-bottom: 1.5px solid #1a1d21; }
h3 { font-size: 13.5px; margin: 12px 0 3px; }
.session { color: #565c64; margin: 2px 0 10px; font-size: 12.5px; overflow-wrap: anywhere; }
.headline { font-size: 18px; font-weight: 600; padding: 9px 14px; border-left: 8px solid; margin: 0 0 10px; }
.headline small { display: block; font-size: 13px; font-weight: 400; margin-top: 3px; }
.bad { background: #fdeee0; border-color: #b34700; } .good { background: #e8f1f9; border-color: #084081; }
.open { background: #f1f1f1; border-color: #777; }
ul { margin: 0; padding-left: 20px; } li { margin: 3px 0; overflow-wrap: anywhere; }
table { border-collapse: collapse; width: 100%; font-size: 12.5px; font-variant-numeric: tabular-nums; }
th { text-align: right; font-weight: 600; vertical-align: bottom; border-bottom: 1.5px solid #555; padding: 3px 6px; }
td { text-align: right; border-bottom: 1px solid #dcdfe3; padding: 2.5px 6px; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
.identity { table-layout: fixed; } .identity td { text-align: left; white-space: normal; overflow-wrap: anywhere; vertical-align: top; }
.identity td:nth-child(odd) { color: #565c64; width: 17%; } .settings td:nth-child(odd) { width: 29%; } .identity td:nth-child(even) { font-weight: 600; }
.wide td { text-align: left; white-space: normal; overflow-wrap: anywhere; } .wide th { text-align: left; }
.files td:nth-child(3) { text-align: right; white-space: nowrap; } .sum { font-family: monospace; font-size: 10px; }
.points { font-size: 11.5px; } .points th, .points td { padding: 2px 4px; }
.defects td, .defects th { padding: 2.5px 5px; } .defects td:nth-child(4), .defects th:nth-child(4),
.defects td:nth-child(5), .defects th:nth-child(5) { text-align: left; }
.chords { font-size: 10px; table-layout: fixed; } .chords th, .chords td { padding: 2.5px 1px; text-align: center; }
.chords td:first-child, .chords th:first-child { text-align: left; font-weight: 600; }
.ring { border: 1.2px solid #b34700; border-radius: 9px; padding: 0 1px; font-weight: 700; }
.chords th:first-child { width: 6%; }
.ring.minus { border-color: #084081; border-style: dashed; }
.doubt { font-style: italic; } .empty { color: #9aa0a6; }
.cut { color: #a04000; } .weld { color: #084081; } .note { color: #565c64; font-size: 12px; margin: 5px 0; }
svg { width: 100%; height: auto; display: block; }
)";

/// Of pictures: within each, so that printers that draw a picture by itself have it too.
constexpr const char* kPrintStyle = R"(
@media print { body { margin: 0; padding: 0; max-width: none; font-size: 9.6pt; print-color-adjust: exact;
  -webkit-print-color-adjust: exact; }
  table { font-size: 8.3pt; } .points { font-size: 7.4pt; } .chords { font-size: 6.4pt; } .note, .session { font-size: 8pt; }
  .sum { font-size: 6.8pt; } svg, tr, .headline, .keep, table.identity, table.defects, table.regions, table.files { break-inside: avoid; } h2, h3 { break-after: avoid; }
  thead { display: table-header-group; } .page { break-before: page; } }
)";

/// A text as a string of a style sheet: whatever could end it, or the sheet, is written as a number.
std::string css_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        byte >= 0x80 || std::isalnum(byte) != 0 || std::string_view(" .,:;-+_()/").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("\\{:06x} ", byte);
  }
  return out + "\"";
}

/// The name of the blade as the head of every page has it.
std::string page_head(const Result& result) {
  if (!result.record) return result.name;
  const ReportIdentity& identity = result.record->identity;
  std::string text = identity.part;
  if (!identity.serial.empty()) text += fmt::format("{}serial {}", text.empty() ? "" : ", ", identity.serial);
  return text.empty() ? result.name : text;
}

std::string page_boxes(const Result& result) {
  constexpr const char* kText = "font: 8pt \"Liberation Sans\", Arial, sans-serif; color: #565c64; content:";
  const std::string version = result.record ? result.record->version : "bladefit";
  const std::string foot = result.written.empty() ? version : version + ", report of " + result.written;
  constexpr std::size_t kMostHead = 80;
  return fmt::format(
      "@page {{ size: A4 portrait; margin: 17mm 12mm 16mm 12mm;\n  @top-left {{ {0} {1}; }}\n  @top-right {{ {0} {2}; "
      "}}\n  @bottom-left {{ {0} {3}; }}\n  @bottom-right {{ {0} \"page \" counter(page) \" of \" counter(pages); }} "
      "}}\n",
      kText, css_string("Blade inspection: " + shortened(page_head(result), kMostHead)),
      css_string(readable(word_of(result.verdict.state))), css_string(foot));
}

}  // namespace

std::string report_style(const Result& result) { return kScreenStyle + page_boxes(result) + kPrintStyle; }

}  // namespace bladefit
