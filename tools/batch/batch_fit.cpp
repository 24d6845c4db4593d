#include "tools/batch/batch_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/batch/cpu_clock.hpp"
#include "tools/batch/result_record.hpp"
#include "tools/batch/whole_fit.hpp"

namespace bladefit {
namespace {

bool is_identity(const Pose& pose) {
  return pose.rotation == Mat3(Mat3::Identity()) && pose.translation == Vec3(Vec3::Zero());
}

std::vector<double> distances_of(const std::vector<Verdict>& verdicts) {
  std::vector<double> distances(verdicts.size());
  std::transform(verdicts.begin(), verdicts.end(), distances.begin(), [](const Verdict& v) { return v.foot.distance; });
  return distances;
}

/// Oriented distances of the points as measured, at C = I, t = 0 [mm], by searches.
std::vector<double> distances_as_measured(const DesignImage& design, const LocalizerConfig& config,
                                          const std::vector<ProbePoint>& points) {
  const Surface surface(design);
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const ProbePoint& point : points) {
    ProjectionQuery query;
    query.point = Vec3(point.position.data());
    if (config.use_approach) query.approach = Vec3(point.approach.data());
    const Projection nearest = project_global(surface, query, nullptr).nearest;
    distances.push_back(foot_of(surface, nearest, config.probe_radius_mm).distance);
  }
  return distances;
}

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

}  // namespace

BatchFit fit_points(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                    const std::string& name) {
  BatchFit batch;
  const double began = thread_cpu_s();
  StagedPoints fit = staged(design, plan, points, plan.starts, name);
  refine_all(*fit.localizer, points.size());
  batch.fit = {thread_cpu_s() - began, fit.searches + fit.localizer->fit().searches};
  const bool tracked = plan.starts == FootStarts::neighbour || plan.starts == FootStarts::curves;
  if (tracked) prove_starts(design, plan, points, name, fit, batch);
  const bool as_measured = is_identity(plan.localizer.start);
  batch.result = result_record(
      {.design = design,
       .plan = plan,
       .points = points,
       .report = fit.localizer->fit(),
       .verdicts = verdicts_of(*fit.localizer, points),
       .before = as_measured ? distances_of(fit.verdicts) : distances_as_measured(design, plan.localizer, points),
       .stream = {}});
  batch.result.name = name;
  return batch;
}

Result result_of(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                 const FitReport& report, const std::vector<Verdict>& verdicts, const StreamEvidence& stream,
                 const std::string& name) {
  Result result = result_record({.design = design,
                                 .plan = plan,
                                 .points = points,
                                 .report = report,
                                 .verdicts = verdicts,
                                 .before = distances_as_measured(design, plan.localizer, points),
                                 .stream = stream});
  result.name = name;
  return result;
}

}  // namespace bladefit
