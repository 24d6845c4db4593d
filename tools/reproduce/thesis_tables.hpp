#pragma once
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tools/reproduce/report_table.hpp"
#include "tools/reproduce/study_runs.hpp"
#include "tools/reproduce/thesis_figures.hpp"

namespace bladefit {

inline constexpr int kThesisTables = 16;

/// 1 is I.
[[nodiscard]] std::string roman(int number);

/// A row of the thesis and the fits of the points that stand in for its own.
struct UnconstrainedPair {
  UnconstrainedFigures thesis;
  SubsetRuns ours;
};
struct ConstrainedPair {
  ConstrainedFigures thesis;
  SubsetRuns ours;
};

/// The tables of `study` whose numbers are in `wanted`, in the thesis' order. `unconstrained` and `constrained` hold
/// its rows where a wanted table needs them.
[[nodiscard]] std::vector<ReportTable> thesis_tables(const ThesisStudy& study, const std::set<int>& wanted,
                                                     const std::vector<UnconstrainedPair>& unconstrained,
                                                     const std::vector<ConstrainedPair>& constrained);

}  // namespace bladefit
