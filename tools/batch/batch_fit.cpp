#include "tools/batch/batch_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/batch/cpu_clock.hpp"
#include "tools/batch/far_points.hpp"
#include "tools/batch/result_record.hpp"
#include "tools/batch/whole_fit.hpp"
#include "tools/batch/world_checks.hpp"

namespace bladefit {
namespace {

bool is_identity(const Pose& pose) {
  return pose.rotation == Mat3(Mat3::Identity()) && pose.translation == Vec3(Vec3::Zero());
}

/// Oriented distances of points as measured, at C = I, t = 0 [mm], by searches. Where the points as measured are far
/// from the design, feet are the nearest whatever the probing directions: hardly one would face the probe there, and to
/// find that out takes milliseconds a point.
class DistanceAsMeasured {
 public:
  /// `points` stand for all.
  DistanceAsMeasured(const DesignImage& design, const LocalizerConfig& config, const std::vector<ProbePoint>& points)
      : surface_(design),
        probe_radius_mm_(config.probe_radius_mm),
        directed_(config.use_approach && !is_far_from(surface_, points, Pose(), config.probe_radius_mm)) {}

  [[nodiscard]] double of(const ProbePoint& point) const {
    ProjectionQuery query;
    query.point = Vec3(point.position.data());
    if (directed_) query.approach = Vec3(point.approach.data());
    const Projection nearest = project_global(surface_, query, nullptr).nearest;
    return foot_of(surface_, nearest, probe_radius_mm_).distance;
  }

 private:
  Surface surface_;
  double probe_radius_mm_;
  bool directed_;
};

/// Points at the start pose, ready to be refined.
struct StagedPoints {
  OwnedLocalizer localizer;
  std::vector<Verdict> verdicts;
  std::uint32_t searches = 0;  ///< beside those the localizer counts
};

StagedPoints staged(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                    FootStarts starts, const std::string& name) {
  StagedPoints stage{OwnedLocalizer(design, plan.localizer, points.size()), {}, 0};
  stage.searches = stage_points(*stage.localizer, Surface(design), plan.localizer, points, starts, name);
  stage.verdicts = verdicts_of(*stage.localizer, points);
  return stage;
}

/// Feet that are not at the same place, to well within what Newton's method leaves.
std::uint32_t different_feet(const std::vector<Verdict>& a, const std::vector<Verdict>& b, double half_diagonal_mm) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i].foot.point - b[i].foot.point).norm() > 1e-7 * half_diagonal_mm) ++count;
  }
  return count;
}

/// Proves the first feet of a fit that only tracked them, by searches. Where one was not the nearest the fit may have
/// gone astray, to another local optimum or to none, and is made again from the searched feet.
void prove_starts(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                  const std::string& name, StagedPoints& fit, BatchFit& batch) {
  const double began = thread_cpu_s();
  StagedPoints searched = staged(design, plan, points, FootStarts::searched, name);
  batch.wrong_starts = different_feet(fit.verdicts, searched.verdicts, Surface(design).half_diagonal());
  if (batch.wrong_starts > 0 || fit.localizer->fit().status == FitStatus::tracking) {
    refine_all(*searched.localizer, points.size());
    batch.proof.searches = searched.localizer->fit().searches;
    fit = std::move(searched);
  } else {
    batch.proof.searches = searched.localizer->fit().searches;
    fit.verdicts = std::move(searched.verdicts);
  }
  batch.proof.cpu_s = thread_cpu_s() - began;
}

/// A fit from the start of its plan, told as it is.
struct FittedPoints {
  BatchFit batch;
  PoseFit quality;
};

FittedPoints fitted_from_start(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                               const std::string& name) {
  FittedPoints out;
  const double began = thread_cpu_s();
  StagedPoints fit = staged(design, plan, points, plan.starts, name);
  refine_all(*fit.localizer, points.size());
  out.batch.fit = {thread_cpu_s() - began, fit.searches + fit.localizer->fit().searches};
  const bool tracked = plan.starts == FootStarts::neighbour || plan.starts == FootStarts::curves;
  if (tracked) prove_starts(design, plan, points, name, fit, out.batch);
  const bool as_measured = is_identity(plan.localizer.start);
  const std::vector<Verdict> verdicts = verdicts_of(*fit.localizer, points);
  out.quality = measure_fit(plan.localizer, points, fit.localizer->fit(), verdicts);
  std::optional<DistanceAsMeasured> measured;
  if (!as_measured) measured.emplace(design, plan.localizer, points);
  Rows<FittedPoint> fitted;
  for (std::size_t i = 0; i < points.size(); ++i)
    fitted.push_back({points[i], verdicts[i], measured ? measured->of(points[i]) : fit.verdicts[i].foot.distance});
  out.batch.result = result_record({.design = design, .plan = plan, .points = fitted, .report = fit.localizer->fit()});
  return out;
}

/// What is told of points that have no pose: nothing but their numbers.
BatchFit without_fit(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Rows<FittedPoint> unfitted;
  for (const ProbePoint& point : points) {
    Verdict verdict;
    verdict.sequence = point.sequence;
    verdict.foot.distance = kUnknown;
    unfitted.push_back({point, verdict, kUnknown});
  }
  FitReport report;
  report.status = FitStatus::tracking;
  report.determined = report.free;
  report.pose = plan.localizer.start;
  BatchFit batch;
  batch.result = result_record({.design = design, .plan = plan, .points = unfitted, .report = report});
  return batch;
}

void add_findings(const Findings& findings, Result& result) {
  std::vector<VerdictReason>& reasons = result.verdict.reasons;
  reasons.insert(reasons.end(), findings.doubts.begin(), findings.doubts.end());
  result.notes.insert(result.notes.end(), findings.notes.begin(), findings.notes.end());
}

/// The fit from the start that the checks chose, and again from a better one where it went astray.
BatchFit checked_fit(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                     const std::string& name) {
  WorldChecks checks(design, plan, points);
  StartChoice choice = checks.choose_start();
  if (choice.hopeless) {
    BatchFit batch = without_fit(design, plan, points);
    add_findings(choice.findings, batch.result);
    return batch;
  }
  FitPlan used = plan;
  used.localizer.start = choice.pose;
  used.localizer.use_approach = plan.localizer.use_approach && !choice.averted;
  FittedPoints fitted = fitted_from_start(design, used, points, name);
  if (!choice.searched) {
    if (const std::optional<StartChoice> better = checks.better_start(fitted.quality)) {
      choice = *better;
      used.localizer.start = choice.pose;
      fitted = fitted_from_start(design, used, points, name);
    }
  }
  add_findings(choice.findings, fitted.batch.result);
  add_findings(checks.findings_of(fitted.quality, choice.searched), fitted.batch.result);
  return std::move(fitted.batch);
}

}  // namespace

BatchFit fit_points(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                    const std::string& name) {
  BatchFit batch = checked_fit(design, plan, points, name);
  batch.result.name = name;
  judge(batch.result, plan.localizer, {});
  return batch;
}

Result result_of(const DesignImage& design, const FitPlan& plan, const Rows<JudgedPoint>& judged,
                 const FitReport& report, const StreamEvidence& stream, const std::string& name) {
  std::vector<ProbePoint> points;
  std::vector<Verdict> verdicts;
  for (const JudgedPoint& some : some_of(judged, kMostLookedAt)) {
    points.push_back(some.point);
    verdicts.push_back(some.verdict);
  }
  const DistanceAsMeasured measured(design, plan.localizer, points);
  Rows<FittedPoint> fitted;
  for (const JudgedPoint& each : judged) fitted.push_back({each.point, each.verdict, measured.of(each.point)});
  Result result = result_record({.design = design, .plan = plan, .points = fitted, .report = report});
  result.name = name;
  add_findings(doubts_about(design, plan, points, report, verdicts), result);
  judge(result, plan.localizer, stream);
  return result;
}

}  // namespace bladefit
