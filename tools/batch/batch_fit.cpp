#include "tools/batch/batch_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/batch/cpu_clock.hpp"
#include "tools/batch/owned_localizer.hpp"
#include "tools/files/exit_codes.hpp"

namespace bladefit {
namespace {

std::vector<Verdict> verdicts_of(const Localizer& localizer, const std::vector<ProbePoint>& points) {
  std::vector<Verdict> verdicts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (localizer.verdict_of(points[i].sequence, verdicts[i]) != Status::ok)
      throw std::logic_error("a staged point is missing");
  }
  return verdicts;
}

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

void refine_all(Localizer& localizer, std::size_t points) {
  localizer.conclude();
  // The refinement has its own cap on sweeps, so this ends.
  while (localizer.refine(static_cast<std::uint32_t>(points)) == Status::more_work) {
  }
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
/// gone astray, to another local optimum or to none, and is made anew from the searched feet.
void prove_starts(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                  const std::string& name, StagedPoints& fit, FitResult& result) {
  const double began = thread_cpu_s();
  StagedPoints searched = staged(design, plan, points, FootStarts::searched, name);
  result.wrong_starts = different_feet(fit.verdicts, searched.verdicts, Surface(design).half_diagonal());
  if (result.wrong_starts > 0 || fit.localizer->fit().status == FitStatus::tracking) {
    refine_all(*searched.localizer, points.size());
    result.proof.searches = searched.localizer->fit().searches;
    fit = std::move(searched);
  } else {
    result.proof.searches = searched.localizer->fit().searches;
    fit.verdicts = std::move(searched.verdicts);
  }
  result.proof.cpu_s = thread_cpu_s() - began;
}

class Summing {
 public:
  explicit Summing(BeforeAfter& sums) : sums_(sums) {}
  ~Summing() {
    if (sums_.count == 0) return;
    sums_.rms_before = std::sqrt(square_before_ / sums_.count);
    sums_.rms_after = std::sqrt(square_after_ / sums_.count);
  }
  Summing(const Summing&) = delete;
  Summing& operator=(const Summing&) = delete;
  void add(double before, double after) {
    ++sums_.count;
    square_before_ += before * before;
    square_after_ += after * after;
    sums_.max_before = std::max(sums_.max_before, std::abs(before));
    sums_.max_after = std::max(sums_.max_after, std::abs(after));
  }

 private:
  BeforeAfter& sums_;
  double square_before_ = 0, square_after_ = 0;
};

void sum_up(FitResult& result, const std::vector<double>& before) {
  Summing all(result.all), leading_edge(result.leading_edge), rest(result.rest);
  for (std::size_t i = 0; i < result.verdicts.size(); ++i) {
    const Verdict& after = result.verdicts[i];
    if (after.state == PointState::rejected) continue;
    all.add(before[i], after.foot.distance);
    (after.region == Region::leading_edge ? leading_edge : rest).add(before[i], after.foot.distance);
  }
}

std::string status_of(const FitReport& report) {
  switch (report.status) {
    case FitStatus::converged:
      return "converged";
    case FitStatus::underdetermined:
      return "underdetermined";
    case FitStatus::infeasible:
      return "infeasible";
    case FitStatus::tracking:
      break;
  }
  return "not_converged";
}

}  // namespace

FitResult fit_points(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                     const std::string& name) {
  FitResult result;
  const double began = thread_cpu_s();
  StagedPoints fit = staged(design, plan, points, plan.starts, name);
  refine_all(*fit.localizer, points.size());
  result.fit = {thread_cpu_s() - began, fit.searches + fit.localizer->fit().searches};
  const bool tracked = plan.starts == FootStarts::neighbour || plan.starts == FootStarts::curves;
  if (tracked) prove_starts(design, plan, points, name, fit, result);
  result.report = fit.localizer->fit();
  result.status = status_of(result.report);
  result.verdicts = verdicts_of(*fit.localizer, points);
  const bool as_measured = is_identity(plan.localizer.start);
  sum_up(result, as_measured ? distances_of(fit.verdicts) : distances_as_measured(design, plan.localizer, points));
  result.aberrant = aberrant_points(result.report, plan.localizer, result.verdicts, points);
  if (result.all.count < 6) {
    throw ToolError(
        fmt::format("{}: {} points count in the fit, at least 6 are needed ({} of {} are outside the window or at an "
                    "edge); probe more points",
                    name, result.all.count, points.size() - result.all.count, points.size()));
  }
  return result;
}

FitResult result_of(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                    const FitReport& report, std::vector<Verdict> verdicts) {
  FitResult result;
  result.report = report;
  result.status = status_of(report);
  result.verdicts = std::move(verdicts);
  sum_up(result, distances_as_measured(design, plan.localizer, points));
  result.aberrant = aberrant_points(report, plan.localizer, result.verdicts, points);
  return result;
}

bool one_tolerance(const ToleranceMap& tolerance) {
  return tolerance.box_count == 0 || !std::isfinite(tolerance.leading_edge_mm);
}

double least_widening(const FitReport& report, const ToleranceMap& tolerance) {
  const bool leading_edge = std::isfinite(tolerance.leading_edge_mm);
  return report.tolerance_factor_mm / (leading_edge ? tolerance.leading_edge_mm : tolerance.rest_mm);
}

int exit_code_of(const FitResult& result) {
  if (result.report.status == FitStatus::infeasible) return kOutOfTolerance;
  const bool out = std::any_of(result.verdicts.begin(), result.verdicts.end(),
                               [](const Verdict& v) { return v.state == PointState::out; });
  return out ? kOutOfTolerance : 0;
}

}  // namespace bladefit
