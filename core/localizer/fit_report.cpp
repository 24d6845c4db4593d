#include "core/localizer/fit_report.hpp"

#include <cmath>

namespace bladefit {
namespace {

RegionReport region_report(const RegionSums& sums, std::uint32_t judged_out) {
  RegionReport report;
  report.count = sums.count;
  report.judged_out = judged_out;
  report.rms_mm = sums.count > 0 ? std::sqrt(sums.square / sums.count) : 0.0;
  report.worst_mm = sums.worst;
  report.worst_sequence = sums.worst_sequence;
  return report;
}

void report_estimate(const LocalizerParts& p, FitReport& report) {
  const PoseEstimate& estimate = p.estimate;
  const QuadraticModel& model = p.sums.model();
  report.pose = estimate.pose();
  const std::uint32_t unknowns = 6 - estimate.determination().locked;
  report.free = unknowns;
  report.determined = estimate.determination().rank - estimate.determination().locked;
  report.smallest_eigenvalue = estimate.determination().smallest;
  report.gradient = estimate.last_step();
  report.revision = estimate.revision();
  report.fitted = model.count;
  const double square = 2.0 * model.value_at(motion_between(model.reference, estimate.pose(), p.problem.frame));
  const bool robust = p.loss.robust();
  if (model.weight > 0.0) report.rms_mm = std::sqrt(square / model.weight);
  if (robust) report.loss_scale_mm = p.loss.scale();
  if (model.count > unknowns) report.sigma_mm = robust ? p.loss.scale() : std::sqrt(square / (model.count - unknowns));
  if (!estimate.determined()) return;
  const double variance = report.sigma_mm * report.sigma_mm;
  report.covariance = pose_covariance(variance * estimate.covariance(), estimate.pose(), p.problem.frame);
  const bool converged = p.refinement.phase() == RefinementPhase::done;
  report.status = p.optimum.infeasible ? FitStatus::infeasible : converged ? FitStatus::converged : FitStatus::tracking;
}

}  // namespace

FitReport report_of(const LocalizerParts& p) {
  FitReport report;
  report_estimate(p, report);
  report.points = p.stream.accepted;
  report.rejected = p.verdicts.rejected();
  report.memory_full = p.stream.accepted > p.store.size();
  const bool converged = p.refinement.phase() == RefinementPhase::done;
  report.improving = p.plan.bounded() && !converged && p.stream_optimum.improving(p.store);
  report.mode_value_mm = p.optimum.value;
  report.smallest_tolerance_mm = p.optimum.smallest_tolerance;
  report.certificate = p.optimum.certificate;
  report.stationarity = p.optimum.stationarity;
  if (p.refinement.further_starts().done()) {
    report.further_starts = p.problem.config.further_starts;
    report.same_optimum = p.refinement.further_starts().same();
  }
  report.ended = p.refinement.ended();
  if (p.plan.bounded() && converged) report.held_feet = p.optimum.held_feet;
  report.unproven = p.refinement.unproven();
  report.searches = p.store.searches();
  report.rest = region_report(p.sums.region(Region::rest), p.verdicts.out(Region::rest));
  report.leading_edge = region_report(p.sums.region(Region::leading_edge), p.verdicts.out(Region::leading_edge));
  return report;
}

}  // namespace bladefit
