#include "tools/batch/robust_check.hpp"

#include "tools/batch/outliers.hpp"
#include "tools/batch/whole_fit.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {
namespace {

/// Of more points some are fitted, evenly taken, which keeps memory and time of a long session within bounds.
constexpr std::size_t kMostFitted = 16384;

std::vector<std::uint32_t> different(const std::vector<Verdict>& a, const std::vector<Verdict>& b) {
  std::vector<std::uint32_t> sequences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (is_judged(a[i].state) && is_judged(b[i].state) && a[i].state != b[i].state) sequences.push_back(a[i].sequence);
  }
  return sequences;
}

/// Those of points that were not fitted are at the same pose.
std::vector<Verdict> all_verdicts(const Localizer& localizer, const std::vector<ProbePoint>& points) {
  std::vector<Verdict> verdicts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (localizer.verdict_of(points[i].sequence, verdicts[i]) != Status::ok)
      static_cast<void>(localizer.judge_aside(points[i], verdicts[i]));
  }
  return verdicts;
}

}  // namespace

RobustCheck check_robustly(const FinishedFit& fit) {
  RobustCheck out;
  LocalizerConfig config = fit.plan.localizer;
  const Surface surface(fit.design);
  if (config.mode != FitMode::least_squares || fit.report.status != FitStatus::converged) return out;
  if (config.loss != Loss::none) {
    out.outliers = find_outliers(fit.report, surface.half_diagonal(), fit.verdicts, fit.points);
    return out;
  }
  config.loss = Loss::tukey;
  const std::vector<ProbePoint> fitted = some_of(fit.points, kMostFitted);
  OwnedLocalizer robust(fit.design, config, fitted.size());
  static_cast<void>(stage_points(*robust, surface, config, fitted, FootStarts::searched, "robust fit"));
  refine_all(*robust, fitted.size());
  if (robust->fit().status != FitStatus::converged) return out;
  const std::vector<Verdict> verdicts = all_verdicts(*robust, fit.points);
  out.outliers = find_outliers(robust->fit(), surface.half_diagonal(), verdicts, fit.points);
  out.judged_otherwise = different(fit.verdicts, verdicts);
  return out;
}

}  // namespace bladefit
