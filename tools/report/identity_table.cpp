#include "tools/report/identity_table.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "tools/report/report_text.hpp"

namespace bladefit {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

void add_entry(Entries& entries, std::string_view label, const std::string& text) {
  if (!text.empty()) entries.emplace_back(label, text);
}

Entries entries_of(const Result& result) {
  Entries entries;
  if (result.record) {
    const ReportRecord& record = *result.record;
    for (const IdentityRow& row : kIdentityRows) add_entry(entries, row.label, record.identity.*row.text);
    for (const auto& [name, text] : record.identity.fields) add_entry(entries, name, text);
    add_entry(entries, "Begun", record.begun);
    add_entry(entries, "Ended", record.ended);
    add_entry(entries, "Judged by", record.version);
  }
  add_entry(entries, "Report of", result.written);
  add_entry(entries, result.identity ? "Session" : "Points", result.name);
  if (result.identity) {
    add_entry(entries, "Design image", fmt::format("{:08x}", result.identity->design_crc));
    add_entry(entries, "Settings", fmt::format("{:016x}", result.identity->config_digest));
  }
  add_entry(entries, "Unit of length", result.units);
  return entries;
}

}  // namespace

std::size_t identity_rows(const Result& result) { return (entries_of(result).size() + 1) / 2; }

std::string identity_table(const Result& result) {
  const Entries entries = entries_of(result);
  std::string html = "<table class=\"identity\"><tbody>\n";
  for (std::size_t k = 0; k < entries.size(); k += 2) {
    html += "<tr>";
    for (const std::size_t i : {k, k + 1}) {
      html += i < entries.size()
                  ? fmt::format("<td>{}</td><td>{}</td>", escaped(entries[i].first), escaped(entries[i].second))
                  : "<td></td><td></td>";
    }
    html += "</tr>\n";
  }
  html += "</tbody></table>\n";
  const bool named = result.record && !result.record->identity.empty();
  if (named) return html;
  return html +
         "<p class=\"note\">The blade is not named: a [report] table in the session's or the fit's settings file names "
         "part, serial number, drawing, order, machine, operator and inspector.</p>\n";
}

std::string files_table(const Result& result) {
  if (!result.record || result.record->files.empty()) return "";
  std::string html =
      "<table class=\"wide files\">\n<thead><tr><th>File</th><th>Path</th><th>Bytes</th><th>SHA-256</th></tr>"
      "</thead>\n<tbody>";
  for (const ReportFile& file : result.record->files) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"sum\">{}</td></tr>\n", escaped(file.role),
                        escaped(file.path), file.size, escaped(file.sha256));
  }
  return html + "</tbody></table>\n";
}

}  // namespace bladefit
