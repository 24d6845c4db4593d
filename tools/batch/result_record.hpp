#pragma once
#include <vector>

#include "core/localizer.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// A finished fit as the localizer tells of it. verdicts[i] and before[i] are those of points[i].
struct FinishedFit {
  const DesignImage& design;
  const FitPlan& plan;
  const std::vector<ProbePoint>& points;
  FitReport report;
  const std::vector<Verdict>& verdicts;  ///< final ones, rising sequence
  std::vector<double> before;            ///< distances at C = I, t = 0 [mm]
};

/// The record of the fit: sums over its points, outliers, and what the mode found. Its name is left empty.
[[nodiscard]] Result result_record(const FinishedFit& fit);

}  // namespace bladefit
