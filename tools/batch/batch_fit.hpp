#pragma once
#include <string>
#include <vector>

#include "core/localizer.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/batch/judged_point.hpp"
#include "tools/results/judgement.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// What a batch fit took.
struct FitCost {
  double cpu_s = 0;            ///< of this thread
  std::uint32_t searches = 0;  ///< global searches for feet
};

/// A batch fit: its result, and how it came about.
struct BatchFit {
  Result result;
  FitCost fit;                     ///< from the first projection to the optimum
  FitCost proof;                   ///< of proving first feet that were only tracked, a second fit included
  std::uint32_t wrong_starts = 0;  ///< of these, how many were not the nearest; then the fit was made again
};

/// The batch fit of `points`: all are projected at the start pose as plan.starts says, then refined until every foot is
/// proven. First feet that were only tracked are proven afterwards; where one was not the nearest, the fit starts again
/// from searched ones, so that the optimum does not depend on plan.starts.
/// Throws ToolError where a point cannot be used; `name` names the points there and in the result.
[[nodiscard]] BatchFit fit_points(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                                  const std::string& name);

/// The result of a fit that was made elsewhere, over a stream of which `stream` tells what is missing. Only the
/// distances before the fit are computed here. What stands against the fit as a whole is sought with kMostLookedAt of
/// the points.
[[nodiscard]] Result result_of(const DesignImage& design, const FitPlan& plan, const Rows<JudgedPoint>& judged,
                               const FitReport& report, const StreamEvidence& stream, const std::string& name);

}  // namespace bladefit
