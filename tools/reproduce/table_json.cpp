#include "tools/reproduce/table_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace bladefit {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson row_json(const ReportTable& table, const TableRow& row) {
  OrderedJson values = OrderedJson::object();
  OrderedJson unreadable = OrderedJson::array();
  for (std::size_t k = 0; k < row.values.size(); ++k) {
    const std::string& key = table.columns[k].key;
    values[key] = std::isfinite(row.values[k]) ? OrderedJson(row.values[k]) : OrderedJson(nullptr);
    if (std::isnan(row.values[k])) unreadable.push_back(key);
  }
  OrderedJson json = {{"label", row.label}, {"source", row.source}};
  if (!row.data.empty()) json["data"] = row.data;
  if (!row.subset.empty()) json["subset"] = row.subset;
  json["values"] = values;
  if (!unreadable.empty()) json["unreadable_in_scan"] = unreadable;
  return json;
}

OrderedJson table_json(const ReportTable& table) {
  OrderedJson json = OrderedJson::object();
  if (table.number > 0) json["number"] = table.number;
  json["title"] = table.title;
  json["rows"] = OrderedJson::array();
  for (const TableRow& row : table.rows) json["rows"].push_back(row_json(table, row));
  json["notes"] = table.notes;
  return json;
}

}  // namespace

std::string tables_json(const std::vector<ReportTable>& tables) {
  OrderedJson json = {{"units", {{"length", "in"}, {"angle", "rad"}, {"time", "s"}}}, {"tables", OrderedJson::array()}};
  for (const ReportTable& table : tables) json["tables"].push_back(table_json(table));
  return json.dump(1) + "\n";
}

}  // namespace bladefit
