#pragma once
#include <string>

#include "tools/reproduce/report_table.hpp"

namespace bladefit {

/// The table as text, its notes below it, every line ended.
[[nodiscard]] std::string table_text(const ReportTable& table);

}  // namespace bladefit
