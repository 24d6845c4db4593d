#pragma once
#include "tools/reproduce/report_table.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {

/// The table of what a fit costs by how its first feet are found, without rows.
[[nodiscard]] ReportTable start_cost_table();

/// Fits `subset` by least squares with each of the four ways and appends a row for each to `table`.
void add_start_costs(const StudyCase& study, const std::string& subset, ReportTable& table);

}  // namespace bladefit
