#include "tools/batch/rival_poses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/batch/blades.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {
namespace {

constexpr int kMostBlades = 9;
/// Points that are looked at first, and those that a rival is fitted to.
constexpr std::size_t kFirstLooks = 5, kRivalPoints = 100;
/// Points of a turned blade lie as near as this to the next one, before the fit; poses that bring the points no farther
/// apart than the second are the same [half diagonals].
constexpr double kNear = 0.05, kSamePose = 0.01;
/// The same of poses that were searched.
constexpr double kSameFound = 0.02;
/// How far off the further starts of few points lie, at least and at most [half diagonals].
constexpr double kLeastOff = 0.01, kMostOff = 0.1;
/// 95 % of the ratios of two root mean squares with n degrees of freedom are below exp(kRmsQuantile / sqrt(n)).
constexpr double kRmsQuantile = 1.645;

ProjectionQuery query_of(const RivalQuestion& question, const Pose& pose, const ProbePoint& point) {
  ProjectionQuery query;
  query.point = apply(pose, Vec3(point.position.data()));
  if (question.plan.localizer.use_approach) query.approach = pose.rotation * Vec3(point.approach.data());
  return query;
}

/// Whether the first of the points lie near to the surface at the pose.
bool is_near(const RivalQuestion& question, const Surface& surface, const std::vector<ProbePoint>& looks,
             const Pose& pose) {
  const double near = kNear * surface.half_diagonal() + question.plan.localizer.probe_radius_mm;
  return std::all_of(looks.begin(), looks.end(), [&](const ProbePoint& point) {
    const ProjectionQuery query{query_of(question, pose, point).point};
    return std::sqrt(project_global(surface, query, nullptr).nearest.distance_squared()) < near;
  });
}

/// The pose turned about an axis of the design.
Pose turned(const Pose& pose, const ShaftAxis& axis, double angle) {
  Vec6 step = Vec6::Zero();
  step.head<3>() = angle * axis.direction;
  return moved(pose, step, axis.point);
}

/// Angles by which one blade of 2 to kMostBlades follows another, each once [rad].
std::vector<double> blade_angles() {
  std::vector<double> angles;
  for (int blades = 2; blades <= kMostBlades; ++blades) {
    for (int k = 1; k < blades; ++k) angles.push_back(2.0 * std::numbers::pi * k / blades);
  }
  std::sort(angles.begin(), angles.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  angles.erase(std::unique(angles.begin(), angles.end(), same), angles.end());
  return angles;
}

struct NamedAxis {
  ShaftAxis axis;
  std::string name;
};

/// The axis that was named, and those of the coordinates.
std::vector<NamedAxis> axes_of(const ShaftAxis& named) {
  std::vector<NamedAxis> axes;
  constexpr std::array<const char*, 3> kNames = {"x axis", "y axis", "z axis"};
  bool known = false;
  for (int k = 0; k < 3; ++k) {
    axes.push_back({{Vec3::Zero(), Vec3::Unit(k)}, kNames.at(static_cast<std::size_t>(k))});
    known = known || (named.point.isZero() && named.direction == axes.back().axis.direction);
  }
  if (!known) axes.push_back({named, "axis"});
  return axes;
}

/// Adds the fit from `start` where it is another pose and fits as well.
void add_rival(const RivalQuestion& question, const std::vector<ProbePoint>& points, double own_rms_mm,
               const Pose& start, const std::string& how, std::vector<Rival>& rivals) {
  const PoseFit fit = fit_candidate(question.design, question.plan.localizer, points, start);
  const double same = kSamePose * Surface(question.design).half_diagonal();
  const bool as_good = 10 * fit.counted >= 9 * fit.points && fits_as_well(fit.rms_mm, own_rms_mm, fit.counted);
  if (!as_good || apart(points, fit.pose, question.own.pose) < same) return;
  for (const Rival& rival : rivals) {
    if (apart(points, fit.pose, rival.fit.pose) < same) return;
  }
  rivals.push_back({fit, own_rms_mm, how});
}

/// Both ways along each degree of freedom, and along combinations of all six.
std::vector<Vec6> start_directions() {
  std::vector<Vec6> directions;
  for (int k = 0; k < 6; ++k) {
    directions.emplace_back(Vec6::Unit(k));
    directions.emplace_back(-Vec6::Unit(k));
  }
  for (unsigned row = 1; row <= 6; ++row) {
    Vec6 direction;  // signs of a Walsh function: rows that have little in common
    for (unsigned k = 0; k < 6; ++k) direction[k] = (std::popcount(row & (k + 1)) % 2 == 0 ? 1.0 : -1.0);
    directions.push_back(direction);
    directions.emplace_back(-direction);
  }
  return directions;
}

}  // namespace

bool fits_as_well(double rms_mm, double own_rms_mm, std::uint32_t count) {
  const double free = std::max(1.0, static_cast<double>(count) - 6.0);
  // Form errors of a blade are no independent errors: however many points there are, half as much again is as good.
  return rms_mm <= std::max(1.5, std::exp(kRmsQuantile / std::sqrt(free))) * own_rms_mm + 1e-9;
}

bool start_prefers(const RivalQuestion& question, const Rival& rival) {
  const Pose& start = question.plan.localizer.start;
  return apart(question.points, start, question.own.pose) < 0.5 * apart(question.points, start, rival.fit.pose);
}

std::vector<Rival> other_blades(const RivalQuestion& question) {
  const Surface surface(question.design);
  const std::vector<ProbePoint> looks = some_of(question.points, kFirstLooks);
  const std::vector<ProbePoint> points = some_of(question.points, kRivalPoints);
  std::vector<Rival> rivals;
  double own_rms_mm = -1;
  for (const NamedAxis& axis : axes_of(question.plan.axis)) {
    for (const double angle : blade_angles()) {
      const Pose pose = turned(question.own.pose, axis.axis, angle);
      if (!is_near(question, surface, looks, pose)) continue;
      if (own_rms_mm < 0)
        own_rms_mm = fit_candidate(question.design, question.plan.localizer, points, question.own.pose).rms_mm;
      add_rival(
          question, points, own_rms_mm, pose,
          fmt::format("turned by {:.4g} degrees about the design's {}", angle * 180 / std::numbers::pi, axis.name),
          rivals);
    }
  }
  return rivals;
}

std::vector<Rival> competing_optima(const RivalQuestion& question) {
  const bool directed = std::any_of(question.points.begin(), question.points.end(),
                                    [](const ProbePoint& p) { return Vec3(p.approach.data()).squaredNorm() > 0.5; });
  const bool few = question.points.size() < kFewPoints;
  if (!few || (directed && question.plan.localizer.use_approach) || question.points.size() <= 6) return {};
  // Rivals are least-squares fits: in another mode they are rivals of the one that it began with, or of that which
  // belongs to its pose.
  const LocalizerConfig& config = question.plan.localizer;
  PoseFit own = fit_candidate(question.design, config, question.points, question.own.pose);
  if (config.mode != FitMode::least_squares) {
    const PoseFit first = fit_candidate(question.design, config, question.points, config.start);
    if (first.counted >= own.counted && first.rms_mm < own.rms_mm) own = first;
  }
  const double length = Surface(question.design).half_diagonal();
  const double was_off = apart(question.points, config.start, own.pose);
  const double off = std::clamp(was_off, kLeastOff * length, kMostOff * length);
  Vec3 middle = Vec3::Zero();
  for (const ProbePoint& point : question.points) middle += apply(own.pose, Vec3(point.position.data()));
  middle /= static_cast<double>(question.points.size());
  const RivalQuestion about_own{question.design, question.plan, question.points, own};
  std::vector<Rival> rivals;
  for (const Vec6& direction : start_directions()) {
    Vec6 step = off * direction;
    step.head<3>() *= 2.0 / length;
    add_rival(about_own, question.points, own.rms_mm, moved(own.pose, step, middle), "", rivals);
  }
  // One bad point makes the root mean squares alike: most points must fit as well, too.
  const bool squares = config.mode == FitMode::least_squares;
  const double typical_mm = squares ? std::min(own.typical_mm, question.own.typical_mm) : own.typical_mm;
  std::erase_if(rivals, [typical_mm](const Rival& rival) {
    return !fits_as_well(rival.fit.typical_mm, typical_mm, rival.fit.counted);
  });
  return rivals;
}

std::vector<Rival> rivals_among(const std::vector<PoseFit>& found, const RivalQuestion& question) {
  std::vector<Rival> rivals;
  const double same = kSameFound * Surface(question.design).half_diagonal();
  for (const PoseFit& other : found) {
    const PoseFit& best = found.front();
    const bool as_good =
        10 * other.counted >= 9 * best.counted && fits_as_well(other.rms_mm, best.rms_mm, best.counted);
    if (as_good && apart(question.points, other.pose, question.own.pose) > same)
      rivals.push_back({other, best.rms_mm, ""});
  }
  return rivals;
}

std::string blades_sentence(const RivalQuestion& question, const std::vector<Rival>& rivals) {
  const Blades blades{Surface(question.design)};
  const FitPlan& plan = question.plan;
  const auto fit = [&](std::uint32_t patch, double rms_mm) {
    return fmt::format("{}, rms {:.4g} {}", blades.name_of(blades.blade_of(patch)), rms_mm / plan.mm_per_unit,
                       plan.units);
  };
  std::string text =
      fmt::format("the points were fitted to {}; as well they fit", fit(question.own.patch, rivals.front().own_rms_mm));
  for (const Rival& rival : rivals) {
    text += fmt::format("{} {} ({})", &rival == &rivals.front() ? "" : ",", fit(rival.fit.patch, rival.fit.rms_mm),
                        rival.how);
  }
  return text;
}

}  // namespace bladefit
