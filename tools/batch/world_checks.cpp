#include "tools/batch/world_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tools/batch/credibility.hpp"
#include "tools/batch/far_points.hpp"
#include "tools/batch/side_check.hpp"
#include "tools/batch/unit_check.hpp"

namespace bladefit {
namespace {

/// Where fewer points than this count they lie well at many poses: what stands against them is that they are few. Of
/// more points than the second all should.
constexpr std::uint32_t kLeastWeighed = 8, kFew = 20;
/// A start that was farther off than this is told [half diagonals].
constexpr double kFarStart = 0.2;
/// A pose is far better where its typical distance is this share of the other's.
constexpr double kFarNearer = 0.5, kMirroredFarBetter = 0.4;

bool are_too_few(const PoseFit& fitted) { return fitted.counted < kLeastWeighed && fitted.points < kFew; }

constexpr const char* kMirroredText =
    "the points fit the design when they are mirrored: an axis has the wrong sign, or the blade is of the other hand; "
    "correct the signs of the columns, or take the other design";
constexpr const char* kHeldText =
    "the points do not come to lie on the design from this start, and locked degrees of freedom keep it; give a nearer "
    "start, or leave --lock out";

std::vector<ProbePoint> mirrored(std::vector<ProbePoint> points, std::size_t axis) {
  for (ProbePoint& point : points) {
    point.position[axis] = -point.position[axis];
    point.approach[axis] = -point.approach[axis];
  }
  return points;
}

}  // namespace

WorldChecks::WorldChecks(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points)
    : design_(design),
      plan_(plan),
      points_(points),
      scale_mm_(scale_of(Surface(design).half_diagonal(), trimmed_extent(points))) {}

const PoseSearch& WorldChecks::search() {
  if (!search_) search_.emplace(design_, plan_.localizer);
  return *search_;
}

const std::vector<PoseFit>& WorldChecks::found_poses() {
  if (!found_) found_ = search().poses_of(points_);
  return *found_;
}

/// A pose from which the points come to lie, near to the given start; nothing where they do not. Where they are near
/// already it is the start itself; else some of them are fitted first, whatever their directions: a fit of all of them
/// from afar would search for feet that face the probe, where there are none.
std::optional<Pose> WorldChecks::usable_start() const {
  const Surface surface(design_);
  const LocalizerConfig& config = plan_.localizer;
  if (is_outside_box(surface, points_, config.start)) return std::nullopt;
  const bool near = !is_far_from(surface, points_, config.start, config.probe_radius_mm);
  if (near && !much_smaller_than_design(surface, points_)) return config.start;
  const PoseFit scouted = fit_candidate(design_, config, some_of(points_, kSearchPoints), config.start);
  if (!is_credible(scouted, scale_mm_)) return std::nullopt;
  return near || config.locked != 0 ? config.start : scouted.pose;
}

StartChoice WorldChecks::choose_start() {
  StartChoice choice;
  choice.pose = plan_.localizer.start;
  if (larger_than_design(Surface(design_), points_)) {
    choice.hopeless = true;
    choice.findings.doubts.push_back(explain_misfit(std::numeric_limits<double>::infinity()));
    return choice;
  }
  if (plan_.search_start) return searched_start();
  if (const std::optional<Pose> usable = usable_start()) {
    if (moved_far(*usable)) choice.findings.notes.push_back(fmt::format("Start: it was {} off", moved_by(*usable)));
    choice.pose = *usable;
    check_directions(choice);
    return choice;
  }
  if (plan_.localizer.locked == 0) return searched_start();
  choice.hopeless = true;
  PoseFit nowhere;  // which is not plausible, so that something is said
  nowhere.points = static_cast<std::uint32_t>(points_.size());
  nowhere.rms_mm = nowhere.typical_mm = std::numeric_limits<double>::infinity();
  choice.findings.doubts.push_back(*explain_misfit_in_frame(nowhere));
  return choice;
}

bool WorldChecks::moved_far(const Pose& pose) const {
  return apart(points_, pose, plan_.localizer.start) > kFarStart * Surface(design_).half_diagonal();
}

void WorldChecks::check_directions(StartChoice& choice) const {
  const std::string text = wrong_directions(design_, plan_, points_, choice.pose);
  if (text.empty()) return;
  choice.averted = true;
  choice.findings.doubts.push_back({Reason::mirrored, text});
}

/// "30 degrees and 104 mm": from the start pose, of the middle of the points.
std::string WorldChecks::moved_by(const Pose& pose) const {
  const Pose& start = plan_.localizer.start;
  Vec3 shift = Vec3::Zero();
  for (const ProbePoint& point : points_) {
    const Vec3 at(point.position.data());
    shift += (apply(pose, at) - apply(start, at)) / static_cast<double>(points_.size());
  }
  const double angle = rotation_log(pose.rotation * start.rotation.transpose()).norm() * 180.0 / std::numbers::pi;
  return fmt::format("{:.3g} degrees and {:.4g} {}", angle, shift.norm() / plan_.mm_per_unit, plan_.units);
}

StartChoice WorldChecks::searched_start() {
  StartChoice choice;
  choice.pose = plan_.localizer.start;
  const std::vector<PoseFit>& poses = found_poses();
  if (poses.empty() || !is_credible(poses.front(), scale_mm_)) {
    choice.hopeless = true;
    const double infinity = std::numeric_limits<double>::infinity();
    choice.findings.doubts.push_back(explain_misfit(poses.empty() ? infinity : poses.front().typical_mm));
    return choice;
  }
  choice.searched = true;
  choice.pose = poses.front().pose;
  choice.findings.notes.push_back(
      plan_.search_start ? std::string("Start: found by search from the points alone")
                         : fmt::format("Start: it was {} off; the pose was found by search", moved_by(choice.pose)));
  check_directions(choice);
  return choice;
}

/// What tells whether the points belong to the design: other modes than least squares bring most points farther away so
/// that some come nearer, so the least-squares fit that belongs to their pose is weighed instead.
PoseFit WorldChecks::weighed(const PoseFit& finished) const {
  if (plan_.localizer.mode == FitMode::least_squares || !is_suspect(finished, scale_mm_)) return finished;
  return fit_candidate(design_, plan_.localizer, some_of(points_, kSearchPoints), finished.pose);
}

std::optional<StartChoice> WorldChecks::better_start(const PoseFit& finished) {
  const PoseFit fitted = weighed(finished);
  if (are_too_few(fitted)) return std::nullopt;
  if (!is_suspect(fitted, scale_mm_) || plan_.localizer.locked != 0) return std::nullopt;
  const std::vector<PoseFit>& poses = found_poses();
  if (poses.empty() || !is_credible(poses.front(), scale_mm_)) return std::nullopt;
  const bool better =
      fitted.counted < poses.front().counted / 2 || poses.front().typical_mm < kFarNearer * fitted.typical_mm;
  if (!better) return std::nullopt;
  return searched_start();
}

bool WorldChecks::fits_mirrored(double best_mm) {
  const std::vector<PoseFit> fits = search().poses_of(mirrored(points_, 0));
  return !fits.empty() && is_credible(fits.front(), scale_mm_) &&
         fits.front().typical_mm < kMirroredFarBetter * best_mm;
}

/// What stands against a fit of which degrees of freedom are locked. The points are mirrored only where they then fit
/// far better with the same locked, about any plane of their frame: where these were free, the mirror image of a few
/// points of a thin blade fits easily, and tells nothing. Nor does one that fits the points inside of the edges less
/// well.
std::optional<VerdictReason> WorldChecks::explain_misfit_in_frame(const PoseFit& fitted) {
  const bool plausible = is_plausible_in_frame(fitted, scale_mm_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PoseFit other = fit_locked_candidate(design_, plan_.localizer,
                                               some_of(mirrored(points_, axis), kSearchPoints), plan_.localizer.start);
    const bool far_better = is_credible(other, scale_mm_) && other.typical_mm < kMirroredFarBetter * fitted.typical_mm;
    if (far_better && !(plausible && fitted.rms_mm < other.rms_mm))
      return VerdictReason{Reason::mirrored, kMirroredText};
  }
  if (plausible) return std::nullopt;
  if (const std::optional<UnitFound> unit = find_unit(search(), points_, fitted.typical_mm))
    return VerdictReason{Reason::wrong_units, unit_sentence(*unit, plan_.points.unit)};
  return VerdictReason{Reason::far_start, kHeldText};
}

/// The one sentence on points that fit nowhere as they are; `best_mm` is the typical distance of their best fit.
VerdictReason WorldChecks::explain_misfit(double best_mm) {
  if (const std::optional<UnitFound> unit = find_unit(search(), points_, best_mm))
    return {Reason::wrong_units, unit_sentence(*unit, plan_.points.unit)};
  if (fits_mirrored(best_mm)) return {Reason::mirrored, kMirroredText};
  const std::string best = std::isfinite(best_mm)
                               ? fmt::format(" (at the best one a quarter of them is farther than {:.3g} {} from it)",
                                             best_mm / plan_.mm_per_unit, plan_.units)
                               : std::string();
  return {Reason::far_start,
          fmt::format("no pose was found at which the points fit this design{}: another blade or part, or points of "
                      "several; check design, points and units",
                      best)};
}

void WorldChecks::tell_rivals(const PoseFit& fitted, bool searched, Findings& findings) {
  if (plan_.localizer.locked != 0) return;
  const RivalQuestion question{design_, plan_, points_, fitted};
  if (const std::vector<Rival> blades = other_blades(question); !blades.empty()) {
    const bool chosen = !searched && std::all_of(blades.begin(), blades.end(), [&question](const Rival& rival) {
      return start_prefers(question, rival);
    });
    if (chosen) {
      findings.notes.push_back(blades_sentence(question, blades) + "; the start pose chose");
    } else {
      findings.doubts.push_back(
          {Reason::ambiguous, blades_sentence(question, blades) + "; give a start near the blade that was probed"});
    }
    return;
  }
  std::vector<Rival> rivals = competing_optima(question);
  if (found_ && searched) {
    const std::vector<Rival> found = rivals_among(*found_, question);
    rivals.insert(rivals.end(), found.begin(), found.end());
  }
  if (rivals.empty()) return;
  const PoseFit& other = rivals.front().fit;
  findings.doubts.push_back(
      {Reason::ambiguous,
       fmt::format("the points fit another pose as well, {} from the start: rms {:.4g} {} there, {:.4g} {} here; probe "
                   "more points, with directions, or give a start by --start pairs",
                   moved_by(other.pose), other.rms_mm / plan_.mm_per_unit, plan_.units,
                   rivals.front().own_rms_mm / plan_.mm_per_unit, plan_.units)});
}

Findings WorldChecks::findings_of(const PoseFit& finished, bool searched) {
  const PoseFit fitted = weighed(finished);
  Findings findings;
  if (are_too_few(fitted)) return findings;
  if (!is_plausible(fitted, scale_mm_) && plan_.localizer.locked != 0) {
    if (std::optional<VerdictReason> reason = explain_misfit_in_frame(fitted))
      findings.doubts.push_back(*std::move(reason));
  } else if (!is_plausible(fitted, scale_mm_)) {
    const std::vector<PoseFit>& poses = found_poses();
    findings.doubts.push_back(
        explain_misfit(poses.empty() ? fitted.typical_mm : std::min(fitted.typical_mm, poses.front().typical_mm)));
  } else {
    tell_rivals(fitted, searched, findings);
  }
  return findings;
}

Findings doubts_about(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                      const FitReport& report, const std::vector<Verdict>& verdicts) {
  const PoseFit fitted = measure_fit(plan.localizer, points, report, verdicts);
  if (const std::string text = wrong_directions(design, plan, points, fitted.pose); !text.empty())
    return {{{Reason::mirrored, text}}, {}};
  WorldChecks checks(design, plan, points);
  if (const std::optional<StartChoice> better = checks.better_start(fitted)) {
    return {
        {{Reason::far_start,
          "the fit came to lie where the points do not: another pose fits far better; give a start near it by --start "
          "pairs, or run localize --start search on the points of this session"}},
        {}};
  }
  return checks.findings_of(fitted, false);
}

}  // namespace bladefit
