#include "core/localizer/fit_problem.hpp"

#include <cmath>

#include "core/fit/motion_lock.hpp"
#include "core/localizer/tuning.hpp"

namespace bladefit {
namespace {

bool finite(const std::array<double, 3>& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

}  // namespace

FitProblem::FitProblem(const DesignImage& design, const LocalizerConfig& wanted) : surface(design), config(wanted) {
  frame.pivot = surface.middle();
  frame.length = surface.half_diagonal();
  if (config.determined_mm == 0.0) config.determined_mm = tuning::kDetermined * frame.length;
}

double FitProblem::reach() const { return tuning::kLongestStep * frame.length; }

Pose FitProblem::moved_and_held(const Pose& pose, const Vec6& x) const {
  return held(moved(pose, x, frame), config.start, config.locked);
}

double FitProblem::tolerance_of(const Foot& foot, MapPart part) const {
  const ToleranceMap& map = config.tolerance;
  if (part.zone != 0) return map.zones[part.zone - 1].limits().of(foot.distance);
  return map.zone_count > 0 ? map.rest_mm : tolerance_at(map, part.region, foot.patch, foot.u, foot.v);
}

Status FitProblem::check(const ProbePoint& point) const {
  if (!finite(point.position) || !finite(point.approach) || !std::isfinite(point.weight)) return Status::not_finite;
  const double length = to_vec3(point.approach).norm();
  const double off = (apply(config.start, to_vec3(point.position)) - frame.pivot).norm();
  if (off > tuning::kFarthestPoint * frame.length) return Status::out_of_range;
  if (!(point.weight >= 1.0 / tuning::kLargestWeight && point.weight <= tuning::kLargestWeight))
    return Status::out_of_range;
  if (point.sequence == 0 || (length != 0.0 && std::abs(length - 1.0) > tuning::kUnitLength))
    return Status::out_of_range;
  return Status::ok;
}

bool FitProblem::on_design(const SurfacePlace& place) const {
  const bool inside = place.u >= 0.0 && place.u <= 1.0 && place.v >= 0.0 && place.v <= 1.0;
  return inside && place.span < surface.image().spans().size();
}

}  // namespace bladefit
