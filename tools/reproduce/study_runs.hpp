#pragma once
#include <optional>
#include <string>

#include "tools/batch/batch_fit.hpp"
#include "tools/reproduce/study_case.hpp"

namespace bladefit {

/// The fits of one subset, without their points. Lengths in mm.
struct SubsetRuns {
  BatchFit least_squares;
  std::optional<BatchFit> smallest;  ///< at the smallest leading-edge tolerance, 10 times it elsewhere
  std::optional<BatchFit> optimum;   ///< least squares within epsilon and 10 epsilon
  double smallest_mm = 0;            ///< that tolerance
  double epsilon_mm = 0;             ///< 1.1 times it, rounded to six digits in the units of the case
};

/// Fits the subset by least squares and, where asked, within tolerances. Throws ToolError where points are missing.
/// Cost: some milliseconds to some hundred, by the number of points.
[[nodiscard]] SubsetRuns run_subset(const StudyCase& study, const std::string& subset, bool constrained);

}  // namespace bladefit
