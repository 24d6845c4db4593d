#include "config/report_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace bladefit {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }

/// What keeps a text from standing on a line of a report; empty = nothing.
std::string fault_of(const std::string& text) {
  if (text.size() > kMostIdentityText)
    return fmt::format("is longer than {} characters; say it in fewer", kMostIdentityText);
  if (std::ranges::any_of(text, is_control)) return "has a line end or a control character; write it in one line";
  return "";
}

void read_identity_text(TableReader& table, std::string_view key, std::string& text) {
  table.read(key, text);
  if (const std::string fault = fault_of(text); table.good() && !fault.empty()) table.fail(key, fault);
}

void read_fields(TableReader& table, ReportIdentity& identity) {
  const std::vector<std::string> keys = table.keys();
  if (keys.size() > kMostIdentityFields)
    return table.fail(keys.back(), fmt::format("is one of more than {} fields; leave some out", kMostIdentityFields));
  identity.fields.clear();
  for (const std::string& key : keys) {
    std::string text;
    read_identity_text(table, key, text);
    if (const std::string fault = fault_of(key); !fault.empty()) table.fail(key, fault);
    identity.fields.emplace_back(key, text);
  }
}

}  // namespace

bool ReportIdentity::empty() const {
  return fields.empty() &&
         std::ranges::all_of(kIdentityRows, [this](const IdentityRow& row) { return (this->*row.text).empty(); });
}

void read_report_table(TableReader& table, ReportIdentity& identity) {
  for (const IdentityRow& row : kIdentityRows) read_identity_text(table, row.key, identity.*row.text);
  if (std::optional<TableReader> fields = table.table("fields")) read_fields(*fields, identity);
  table.finish();
}

Failure load_report_identity(const std::string& path, ReportIdentity& identity) {
  TomlDocument document = read_toml(path);
  if (document.error) return document.error;
  TableReader root(document, document.root, "");
  ReportIdentity read;
  if (std::optional<TableReader> table = root.table("report")) read_report_table(*table, read);
  if (!document.error) identity = std::move(read);
  return document.error;
}

}  // namespace bladefit
