#pragma once
#include <vector>

#include "tools/reproduce/report_table.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {

/// The thesis' two checks of validity (5.3.1) with the motion that the points of `subset` give: the design moved by the
/// inverse of the motion is localized to the zero motion; points sampled off the moved design are brought back by
/// the same motion. Appends two rows of what is left over to `table`, which check_table() made.
void add_validity_checks(const StudyCase& study, const std::string& subset, ReportTable& table);

/// The table of the checks, without rows.
[[nodiscard]] ReportTable check_table();

}  // namespace bladefit
