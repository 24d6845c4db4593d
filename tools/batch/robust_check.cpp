#include "tools/batch/robust_check.hpp"

#include "tools/batch/outliers.hpp"
#include "tools/batch/whole_fit.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {
namespace {

bool judged_otherwise(const Verdict& a, const Verdict& b) {
  return is_judged(a.state) && is_judged(b.state) && a.state != b.state;
}

/// Those of points that were not fitted are at the same pose.
Verdict verdict_by(const Localizer& localizer, const ProbePoint& point) {
  Verdict verdict;
  if (localizer.verdict_of(point.sequence, verdict) != Status::ok)
    static_cast<void>(localizer.judge_aside(point, verdict));
  return verdict;
}

std::vector<ProbePoint> points_to_fit(const Rows<FittedPoint>& points) {
  std::vector<ProbePoint> out;
  for (const FittedPoint& fitted : some_of(points, kMostLookedAt)) out.push_back(fitted.point);
  return out;
}

}  // namespace

RobustCheck check_robustly(const FinishedFit& fit) {
  RobustCheck out;
  LocalizerConfig config = fit.plan.localizer;
  const Surface surface(fit.design);
  if (config.mode != FitMode::least_squares || fit.report.status != FitStatus::converged) return out;
  Rows<Residual> residuals;
  if (config.loss != Loss::none) {
    for (const FittedPoint& fitted : fit.points) residuals.push_back(residual_of(fitted.point, fitted.verdict));
    out.outliers = find_outliers(fit.report, surface.half_diagonal(), residuals);
    return out;
  }
  config.loss = Loss::tukey;
  const std::vector<ProbePoint> some = points_to_fit(fit.points);
  OwnedLocalizer robust(fit.design, config, some.size());
  static_cast<void>(stage_points(*robust, surface, config, some, FootStarts::searched, "robust fit"));
  refine_all(*robust, some.size());
  if (robust->fit().status != FitStatus::converged) return out;
  for (const FittedPoint& fitted : fit.points) {
    const Verdict verdict = verdict_by(*robust, fitted.point);
    residuals.push_back(residual_of(fitted.point, verdict));
    if (judged_otherwise(fitted.verdict, verdict)) out.judged_otherwise.push_back(fitted.verdict.sequence);
  }
  out.outliers = find_outliers(robust->fit(), surface.half_diagonal(), residuals);
  return out;
}

}  // namespace bladefit
