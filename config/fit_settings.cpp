#include "config/fit_settings.hpp"

#include <utility>

#include "config/fit_table.hpp"
#include "config/report_identity.hpp"
#include "config/zone_table.hpp"

namespace bladefit {

Failure load_fit(const std::string& path, FitSettings& settings) {
  TomlDocument document = read_toml(path);
  if (document.error) return document.error;
  FitSettings read = settings;
  TableReader root(document, document.root, "");
  if (std::optional<TableReader> fit = root.table("fit")) read_fit_table(*fit, read);
  read_zone_tables(root, read.zones);
  ReportIdentity checked;
  if (std::optional<TableReader> report = root.table("report")) read_report_table(*report, checked);
  root.finish();
  if (!document.error) settings = std::move(read);
  return document.error;
}

}  // namespace bladefit
