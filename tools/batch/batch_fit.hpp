#pragma once
#include <string>
#include <vector>

#include "core/localizer.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/batch/outliers.hpp"

namespace bladefit {

/// Distances before the fit, at C = I, t = 0 whatever the start pose, and after it over the points of one kind that
/// count in it [mm].
struct BeforeAfter {
  std::uint32_t count = 0;
  double rms_before = 0, rms_after = 0, max_before = 0, max_after = 0;
};

/// What a batch fit took.
struct FitCost {
  double cpu_s = 0;            ///< of this thread
  std::uint32_t searches = 0;  ///< global searches for feet
};

/// A finished fit and all its points: what result.json and the operator's summary are made from.
struct FitResult {
  std::string status;  ///< converged, infeasible, underdetermined or not_converged
  FitReport report;
  std::vector<Verdict> verdicts;  ///< final ones, rising sequence; index in the points file = sequence - 1
  BeforeAfter all, leading_edge, rest;
  AberrantPoints aberrant;
  FitCost fit;                     ///< from the first projection to the optimum; of a batch fit alone
  FitCost proof;                   ///< of proving first feet that were only tracked, a second fit included
  std::uint32_t wrong_starts = 0;  ///< of these, how many were not the nearest; then the fit was made anew
};

/// The batch fit of `points`: all are projected at the start pose as plan.starts says, then refined until every foot is
/// proven. First feet that were only tracked are proven afterwards; where one was not the nearest, the fit starts anew
/// from searched ones, so that the optimum does not depend on plan.starts.
/// Throws ToolError where fewer than six points count or a point cannot be used; `name` names the points there.
[[nodiscard]] FitResult fit_points(const DesignImage& design, const FitPlan& plan,
                                   const std::vector<ProbePoint>& points, const std::string& name);

/// The result of a fit that was made elsewhere: only the distances before it are computed here.
[[nodiscard]] FitResult result_of(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                                  const FitReport& report, std::vector<Verdict> verdicts);

/// Whether one tolerance holds for the whole blade: there is no leading edge, or it has no tolerance.
[[nodiscard]] bool one_tolerance(const ToleranceMap& tolerance);

/// Of an infeasible constrained fit: the number by which its tolerances must be multiplied at least to be met.
[[nodiscard]] double least_widening(const FitReport& report, const ToleranceMap& tolerance);

/// result.json: UTF-8 text with a final newline, lengths in plan.units. Numbers are written so that they read back as
/// the same bits.
[[nodiscard]] std::string result_json(const FitResult& result, const FitPlan& plan);

/// Exit code: 1 where a point is out of tolerance or no pose meets the tolerances, else 0.
[[nodiscard]] int exit_code_of(const FitResult& result);

/// What the operator wants to know, some lines: points, fit, and the points out of tolerance with cut or weld.
[[nodiscard]] std::string operator_summary(const FitResult& result, const FitPlan& plan, const DesignImage& design);

}  // namespace bladefit
