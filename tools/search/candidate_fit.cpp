#include "tools/search/candidate_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tools/search/owned_localizer.hpp"

namespace bladefit {
namespace {

/// Sweeps of one candidate: six to ten are usual, and what needs more is not the pose sought.
constexpr int kSweeps = 24;
/// A direction along the surface tells nothing: its cosine with the normal must be this large.
constexpr double kTells = 0.3;
/// Share of the points that are to be nearer than the typical distance: defects and outliers are beyond it.
constexpr double kTypicalShare = 0.75;

LocalizerConfig plain(const LocalizerConfig& config, const Pose& start) {
  LocalizerConfig out;
  out.probe_radius_mm = config.probe_radius_mm;
  out.use_approach = false;  // a search for feet that face the probe has no bound where none is near
  out.start = start;
  return out;
}

double typical(std::vector<double>& sizes) {
  if (sizes.empty()) return 0.0;
  const auto place = static_cast<std::ptrdiff_t>(kTypicalShare * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), sizes.begin() + place, sizes.end());
  return sizes[static_cast<std::size_t>(place)];
}

/// Counts the direction of a point whose foot has this outward normal.
void count_direction(const Pose& pose, const ProbePoint& point, const Vec3& normal, PoseFit& fit) {
  const double cosine = normal.dot(pose.rotation * Vec3(point.approach.data()));
  if (std::abs(cosine) < kTells) return;
  ++fit.told;
  if (cosine > 0.0) ++fit.averted;
}

std::uint32_t commonest_patch(const std::vector<Verdict>& verdicts) {
  std::map<std::uint32_t, std::uint32_t> count;
  for (const Verdict& verdict : verdicts) ++count[verdict.foot.patch];
  const auto most =
      std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == count.end() ? 0 : most->first;
}

}  // namespace

PoseFit measure_fit(const LocalizerConfig& config, const std::vector<ProbePoint>& points, const FitReport& report,
                    const std::vector<Verdict>& verdicts) {
  const bool directed = config.use_approach;
  PoseFit fit;
  fit.pose = report.pose;
  fit.points = static_cast<std::uint32_t>(points.size());
  fit.determined = report.determined;
  fit.settled =
      (report.status == FitStatus::converged || report.status == FitStatus::infeasible) && report.unproven == 0;
  double square = 0;
  std::vector<double> sizes;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 at = apply(report.pose, Vec3(points[k].position.data()));
    const double distance = (at - verdicts[k].foot.point).norm();
    sizes.push_back(std::abs(distance - config.probe_radius_mm));
    if (verdicts[k].state == PointState::rejected || verdicts[k].foot.kind != FootKind::interior) continue;
    ++fit.counted;
    if (directed) count_direction(report.pose, points[k], verdicts[k].foot.normal, fit);
    square += verdicts[k].foot.distance * verdicts[k].foot.distance;
  }
  if (fit.counted > 0) fit.rms_mm = std::sqrt(square / fit.counted);
  fit.typical_mm = typical(sizes);
  fit.patch = commonest_patch(verdicts);
  return fit;
}

namespace {

PoseFit fit_with(const LocalizerConfig& own, const LocalizerConfig& config, const DesignImage& design,
                 const std::vector<ProbePoint>& points) {
  OwnedLocalizer localizer(design, own, points.size());
  std::vector<ProbePoint> taken;
  for (const ProbePoint& point : points) {
    if (succeeded(localizer->stage(point))) taken.push_back(point);
  }
  localizer->conclude();
  const auto count = static_cast<std::uint32_t>(points.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    if (localizer->refine(count) != Status::more_work) break;
  }
  std::vector<Verdict> verdicts(taken.size());
  for (std::size_t k = 0; k < taken.size(); ++k) {
    if (!succeeded(localizer->verdict_of(taken[k].sequence, verdicts[k]))) verdicts[k].state = PointState::rejected;
  }
  return measure_fit(config, taken, localizer->fit(), verdicts);
}

}  // namespace

PoseFit fit_candidate(const DesignImage& design, const LocalizerConfig& config, const std::vector<ProbePoint>& points,
                      const Pose& start) {
  return fit_with(plain(config, start), config, design, points);
}

PoseFit fit_locked_candidate(const DesignImage& design, const LocalizerConfig& config,
                             const std::vector<ProbePoint>& points, const Pose& start) {
  LocalizerConfig own = plain(config, start);
  own.locked = config.locked;
  return fit_with(own, config, design, points);
}

}  // namespace bladefit
