#include "tools/batch/robust_check.hpp"

#include "tools/batch/outliers.hpp"
#include "tools/batch/whole_fit.hpp"

namespace bladefit {
namespace {

std::vector<std::uint32_t> different(const std::vector<Verdict>& a, const std::vector<Verdict>& b) {
  std::vector<std::uint32_t> sequences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (is_judged(a[i].state) && is_judged(b[i].state) && a[i].state != b[i].state) sequences.push_back(a[i].sequence);
  }
  return sequences;
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
  OwnedLocalizer robust(fit.design, config, fit.points.size());
  static_cast<void>(stage_points(*robust, surface, config, fit.points, FootStarts::searched, "robust fit"));
  refine_all(*robust, fit.points.size());
  if (robust->fit().status != FitStatus::converged) return out;
  const std::vector<Verdict> verdicts = verdicts_of(*robust, fit.points);
  out.outliers = find_outliers(robust->fit(), surface.half_diagonal(), verdicts, fit.points);
  out.judged_otherwise = different(fit.verdicts, verdicts);
  return out;
}

}  // namespace bladefit
