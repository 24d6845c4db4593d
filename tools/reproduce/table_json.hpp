#pragma once
#include <string>
#include <vector>

#include "tools/reproduce/report_table.hpp"

namespace bladefit {

/// All tables as JSON: numbers in full, null where there is none. Ends with a newline.
[[nodiscard]] std::string tables_json(const std::vector<ReportTable>& tables);

}  // namespace bladefit
