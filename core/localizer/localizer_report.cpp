#include <algorithm>
#include <cmath>

#include "core/localizer.hpp"

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

}  // namespace

Verdict Localizer::verdict_from(const StoredPoint& point) const {
  Verdict verdict;
  verdict.sequence = point.sequence;
  verdict.foot = point.foot;
  verdict.region = point.region;
  verdict.tolerance_mm = point.tolerance;
  verdict.uncertainty_mm = point.uncertainty;
  verdict.state = point.state;
  verdict.action = point.action;
  verdict.revision = point.revision;
  return verdict;
}

void Localizer::queue_revision(std::uint32_t index) {
  if (points_[index].queued) return;
  points_[index].queued = true;
  queue_[(queue_head_ + queue_size_) % config_.capacity] = index;
  ++queue_size_;
}

bool Localizer::next_revision(Verdict& verdict) {
  while (queue_size_ > 0) {
    StoredPoint& point = points_[queue_[queue_head_]];
    queue_head_ = (queue_head_ + 1) % config_.capacity;
    --queue_size_;
    point.queued = false;
    if (point.state == point.told_state && point.action == point.told_action) continue;  // changed back meanwhile
    point.told_state = point.state;
    point.told_action = point.action;
    verdict = verdict_from(point);
    return true;
  }
  return false;
}

Status Localizer::verdict_of(std::uint32_t sequence, Verdict& verdict) const {
  const std::uint32_t* end = order_ + stored_;
  const std::uint32_t* found =
      std::lower_bound(static_cast<const std::uint32_t*>(order_), end, sequence,
                       [this](std::uint32_t i, std::uint32_t wanted) { return points_[i].sequence < wanted; });
  if (found == end || points_[*found].sequence != sequence) return Status::not_found;
  verdict = verdict_from(points_[*found]);
  return Status::ok;
}

FitReport Localizer::fit() const {
  const QuadraticModel& model = current_.model;
  FitReport report;
  report.pose = pose_;
  report.determined = determination_.rank;
  report.points = accepted_;
  report.fitted = model.count;
  report.rejected = rejected_;
  report.smallest_eigenvalue = determination_.smallest;
  report.gradient = last_step_;
  report.revision = revision_;
  report.improving = improving();
  report.memory_full = accepted_ > stored_;
  const double square = 2.0 * model.value_at(motion_between(model.reference, pose_, frame_));
  const std::uint32_t unknowns = 6 - determination_.locked;
  const bool robust = loss_ != Loss::none;
  if (model.weight > 0.0) report.rms_mm = std::sqrt(square / model.weight);
  if (robust) report.loss_scale_mm = loss_scale_;
  if (model.count > unknowns) report.sigma_mm = robust ? loss_scale_ : std::sqrt(square / (model.count - unknowns));
  if (determination_.rank == 6) {
    report.covariance = pose_covariance(report.sigma_mm * report.sigma_mm * covariance_, pose_, frame_);
    report.status = infeasible_ ? FitStatus::infeasible : converged_ ? FitStatus::converged : FitStatus::tracking;
  }
  report.tolerance_factor_mm = tolerance_factor_;
  report.smallest_tolerance_mm = smallest_tolerance_;
  report.certificate = certificate_;
  report.stationarity = stationarity_;
  report.further_starts = refinement_.further.done ? config_.further_starts : 0;
  report.same_optimum = refinement_.further.done ? refinement_.further.same : 0;
  report.unproven = unproven_;
  report.searches = searches_;
  report.rest = region_report(current_.regions[0], judged_out_[0]);
  report.leading_edge = region_report(current_.regions[1], judged_out_[1]);
  return report;
}

}  // namespace bladefit
