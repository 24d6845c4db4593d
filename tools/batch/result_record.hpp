#pragma once
#include "core/localizer.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/batch/judged_point.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// A finished fit as the localizer tells of it.
struct FinishedFit {
  const DesignImage& design;
  const FitPlan& plan;
  const Rows<FittedPoint>& points;  ///< rising sequence
  FitReport report;
};

/// The record of the fit: sums over its points, outliers, and what the mode found. Its name is left empty.
[[nodiscard]] Result result_record(const FinishedFit& fit);

}  // namespace bladefit
