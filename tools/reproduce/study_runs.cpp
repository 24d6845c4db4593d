#include "tools/reproduce/study_runs.hpp"

#include <cmath>

namespace bladefit {
namespace {

constexpr double kRatio = 10;        ///< of the tolerances (thesis 5.3.2)
constexpr double kAboveLeast = 1.1;  ///< leaves the optimum some room

double rounded(double value, int digits) {
  const double unit = std::pow(10.0, digits - 1 - static_cast<int>(std::floor(std::log10(value))));
  return std::round(value * unit) / unit;
}

BatchFit run(const StudyCase& study, const FitPlan& plan, const std::vector<ProbePoint>& points,
             const std::string& subset) {
  BatchFit fit = fit_points(study.design, plan, points, study.points.at(subset).string());
  fit.result.points.clear();
  return fit;
}

}  // namespace

SubsetRuns run_subset(const StudyCase& study, const std::string& subset, bool constrained) {
  const std::vector<ProbePoint> points = read_subset_points(study, subset);
  FitPlan plan = study.plan;
  SubsetRuns runs;
  runs.least_squares = run(study, plan, points, subset);
  if (!constrained) return runs;
  plan.localizer.ratio = kRatio;
  plan.localizer.mode = FitMode::min_tolerance;
  runs.smallest = run(study, plan, points, subset);
  runs.smallest_mm = runs.smallest->result.tolerance_factor;
  if (!(runs.smallest_mm > 0)) return runs;
  runs.epsilon_mm = plan.mm_per_unit * rounded(kAboveLeast * runs.smallest_mm / plan.mm_per_unit, 6);
  plan.localizer.mode = FitMode::constrained;
  plan.localizer.tolerance.leading_edge_mm = runs.epsilon_mm;
  plan.localizer.tolerance.rest_mm = kRatio * runs.epsilon_mm;
  runs.optimum = run(study, plan, points, subset);
  return runs;
}

}  // namespace bladefit
