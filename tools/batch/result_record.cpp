#include "tools/batch/result_record.hpp"

#include <algorithm>
#include <cmath>

#include "tools/batch/robust_check.hpp"
#include "tools/batch/tip_radius.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

/// Sums up in the order of the points.
class Summing {
 public:
  void add(double before, double after) {
    ++count_;
    square_before_ += before * before;
    square_after_ += after * after;
    max_before_ = std::max(max_before_, std::abs(before));
    max_after_ = std::max(max_after_, std::abs(after));
  }

  void write(FitDistances& sums) const {
    if (count_ == 0) return;
    sums.count = count_;
    sums.rms_before = std::sqrt(square_before_ / count_);
    sums.rms_after = std::sqrt(square_after_ / count_);
    sums.max_after = max_after_;
  }

  [[nodiscard]] double max_before() const { return max_before_; }

 private:
  std::uint32_t count_ = 0;
  double square_before_ = 0, square_after_ = 0, max_before_ = 0, max_after_ = 0;
};

void sum_up(const FinishedFit& fit, Result& result) {
  Summing all, leading_edge, rest;
  for (const FittedPoint& fitted : fit.points) {
    const Verdict& after = fitted.verdict;
    if (!after.fitted || std::isnan(after.foot.distance)) continue;
    all.add(fitted.before, after.foot.distance);
    (after.region == Region::leading_edge ? leading_edge : rest).add(fitted.before, after.foot.distance);
  }
  all.write(result.all);
  result.all.max_before = all.max_before();
  leading_edge.write(result.leading_edge);
  rest.write(result.rest);
}

ResultPoint point_of(const FittedPoint& fitted) {
  const Verdict& verdict = fitted.verdict;
  const Foot& foot = verdict.foot;
  return {.sequence = verdict.sequence,
          .position = fitted.point.position,
          .patch = foot.patch,
          .u = foot.u,
          .v = foot.v,
          .kind = foot.kind,
          .region = verdict.region,
          .zone = verdict.zone,
          .distance = foot.distance,
          .tolerance = verdict.tolerance_mm,
          .uncertainty = verdict.uncertainty_mm,
          .expanded = verdict.expanded_mm,
          .before = fitted.before,
          .state = verdict.state,
          .action = verdict.action,
          .left_out = verdict.left_out,
          .beyond = foot.beyond,
          .foot = foot.point};
}

/// The tolerances that were asked for, or in min_tolerance those that were found.
void set_tolerances(const FinishedFit& fit, Result& result) {
  const LocalizerConfig& config = fit.plan.localizer;
  const double factor = fit.report.mode_value_mm;
  const bool found = config.mode == FitMode::min_tolerance && factor > 0.0;
  const double edge = tightest_of(config.tolerance, Region::leading_edge);
  const double rest = tightest_of(config.tolerance, Region::rest);
  if (config.tolerance.zone_count > 0) {
    const double share = found ? factor / (std::isfinite(edge) ? edge : rest) : 1.0;
    result.leading_edge.tolerance = share * edge;
    result.rest.tolerance = share * rest;
    return;
  }
  result.leading_edge.tolerance = found ? factor : edge;
  result.rest.tolerance = found ? config.ratio * factor : rest;
}

void add_zones(const FinishedFit& fit, Result& result) {
  const ToleranceMap& map = fit.plan.localizer.tolerance;
  for (std::size_t k = 0; k < fit.plan.zones.size(); ++k) {
    const ToleranceZone& zone = map.zones.at(k);
    const PlannedZone& planned = fit.plan.zones[k];
    result.zones.push_back({planned.name, planned.where, zone.region, zone.plus_mm, zone.minus_mm});
  }
  if (!result.zones.empty()) result.rest_outside = map.rest_mm;
}

FitDetails details_of(const FinishedFit& fit) {
  const LocalizerConfig& config = fit.plan.localizer;
  return {.mode = config.mode,
          .ratio = config.ratio,
          .leading_edge_tolerance = tightest_of(config.tolerance, Region::leading_edge),
          .rest_tolerance = tightest_of(config.tolerance, Region::rest),
          .determined = fit.report.determined,
          .free = fit.report.free,
          .unproven = fit.report.unproven,
          .ended = fit.report.ended,
          .held_feet = fit.report.held_feet,
          .stationarity = fit.report.stationarity};
}

}  // namespace

Result result_record(const FinishedFit& fit) {
  const LocalizerConfig& config = fit.plan.localizer;
  const FitReport& report = fit.report;
  Result result;
  result.status = word_of(report.status);
  result.mode = word_of(fit.plan.localizer.mode);
  result.units = fit.plan.units;
  result.mm_per_unit = fit.plan.mm_per_unit;
  result.pose = report.pose;
  // sigma^2 (J'J)^-1 is that of the least-squares pose alone.
  const bool determined = report.determined >= report.free && report.fitted > report.free;
  if (config.mode == FitMode::least_squares && determined) result.covariance = report.covariance;
  sum_up(fit, result);
  set_tolerances(fit, result);
  add_zones(fit, result);
  const ToleranceMap& map = config.tolerance;
  result.boxes.assign(map.boxes.begin(), map.boxes.begin() + map.box_count);
  result.tolerance_factor = report.mode_value_mm;
  result.certificate = report.certificate;
  result.further_starts = report.further_starts;
  result.same_optimum = report.same_optimum;
  result.axis = fit.plan.axis;
  const double given = fit.plan.tip_radius_mm;
  result.tip_radius = given > 0.0 ? given : tip_radius_of(Surface(fit.design), fit.plan.axis);
  result.locked = names_of_locked(config.locked);
  if (config.loss != Loss::none) {
    result.loss = LossUsed{std::string(word_of(config.loss)), report.loss_scale_mm};
  }
  RobustCheck robust = check_robustly(fit);
  result.outliers = std::move(robust.outliers);
  result.judged_otherwise = std::move(robust.judged_otherwise);
  for (const FittedPoint& fitted : fit.points) result.points.push_back(point_of(fitted));
  result.details = details_of(fit);
  return result;
}

}  // namespace bladefit
