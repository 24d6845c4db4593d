#include "tools/batch/world_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tools/batch/blades.hpp"
#include "tools/batch/credibility.hpp"
#include "tools/batch/far_points.hpp"
#include "tools/batch/side_check.hpp"
#include "tools/batch/unit_check.hpp"

namespace bladefit {
namespace {

/// Where fewer points than this count they lie well at many poses: what stands against them is that they are few. Of
/// more points than the second all should.
constexpr std::uint32_t kLeastWeighed = 8, kFew = 20;
/// A pose is far better where its typical distance is this share of the other's.
constexpr double kFarBetter = 0.5, kMirroredFarBetter = 0.4;
/// Searched poses that bring the points less far apart are the same [half diagonals].
constexpr double kSamePose = 0.02;

bool are_too_few(const PoseFit& fitted) { return fitted.counted < kLeastWeighed && fitted.points < kFew; }

std::vector<ProbePoint> mirrored(std::vector<ProbePoint> points) {
  for (ProbePoint& point : points) {
    point.position[0] = -point.position[0];
    point.approach[0] = -point.approach[0];
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

bool WorldChecks::start_is_far() const {
  const Surface surface(design_);
  const LocalizerConfig& config = plan_.localizer;
  if (is_outside_box(surface, points_, config.start)) return true;
  const bool near = !is_far_from(surface, points_, config.start, config.probe_radius_mm);
  if (near && !much_smaller_than_design(surface, points_)) return false;
  const PoseFit scouted = fit_candidate(design_, config, some_of(points_, kSearchPoints), config.start);
  return !is_credible(scouted, scale_mm_);
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
  if (!start_is_far()) {
    check_directions(choice);
    return choice;
  }
  if (plan_.localizer.locked == 0) return searched_start();
  choice.hopeless = true;
  choice.findings.doubts.push_back(
      {Reason::far_start,
       "the points do not come to lie on the design from this start, and locked degrees of freedom "
       "keep it; give a nearer start, or leave --lock out"});
  return choice;
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

std::optional<StartChoice> WorldChecks::better_start(const PoseFit& fitted) {
  if (are_too_few(fitted)) return std::nullopt;
  if (!is_suspect(fitted, scale_mm_) || plan_.localizer.locked != 0) return std::nullopt;
  const std::vector<PoseFit>& poses = found_poses();
  if (poses.empty() || !is_credible(poses.front(), scale_mm_)) return std::nullopt;
  const bool better =
      fitted.counted < poses.front().counted / 2 || poses.front().typical_mm < kFarBetter * fitted.typical_mm;
  if (!better) return std::nullopt;
  return searched_start();
}

bool WorldChecks::fits_mirrored(double best_mm) {
  const std::vector<PoseFit> fits = search().poses_of(mirrored(points_));
  return !fits.empty() && is_credible(fits.front(), scale_mm_) &&
         fits.front().typical_mm < kMirroredFarBetter * best_mm;
}

/// The one sentence on points that fit nowhere as they are; `best_mm` is the typical distance of their best fit.
VerdictReason WorldChecks::explain_misfit(double best_mm) {
  if (const std::optional<UnitFound> unit = find_unit(search(), points_, best_mm))
    return {Reason::wrong_units, unit_sentence(*unit, plan_.units)};
  if (fits_mirrored(best_mm)) {
    return {
        Reason::mirrored,
        "the points fit the design when they are mirrored: an axis has the wrong sign, or the blade is of the other "
        "hand; correct the signs of the columns, or take the other design"};
  }
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
  std::vector<Rival> rivals = other_blades(question);
  const Surface surface(design_);
  const Blades blades(surface);
  const auto length = [this](double mm) { return fmt::format("{:.4g} {}", mm / plan_.mm_per_unit, plan_.units); };
  for (const Rival& rival : rivals) {
    const std::string text = fmt::format("the points fit {} as well: rms {} there, {} on {}",
                                         blades.name_of(blades.blade_of(rival.fit.patch)), length(rival.fit.rms_mm),
                                         length(rival.own_rms_mm), blades.name_of(blades.blade_of(fitted.patch)));
    if (!searched && start_prefers(question, rival)) {
      findings.notes.push_back(fmt::format("{} ({}); the start pose chose", text, rival.how));
    } else {
      findings.doubts.push_back({Reason::ambiguous,
                                 fmt::format("{} ({}); give a start near the blade that was probed", text, rival.how)});
    }
  }
  if (!rivals.empty()) return;
  rivals = competing_optima(question);
  if (found_ && searched) {
    const PoseFit& best = found_->front();
    for (const PoseFit& other : *found_) {
      const bool as_good =
          10 * other.counted >= 9 * best.counted && fits_as_well(other.rms_mm, best.rms_mm, best.counted);
      const bool apart_enough = apart(points_, other.pose, fitted.pose) > kSamePose * surface.half_diagonal();
      if (as_good && apart_enough) rivals.push_back({other, best.rms_mm, ""});
    }
  }
  if (rivals.empty()) return;
  const Rival& rival = rivals.front();
  findings.doubts.push_back(
      {Reason::ambiguous,
       fmt::format(
           "the points fit another pose as well, {} from the start: rms {} there, {} here; probe more points, with "
           "directions, or give a start by --start pairs",
           moved_by(rival.fit.pose), length(rival.fit.rms_mm), length(rival.own_rms_mm))});
}

Findings WorldChecks::findings_of(const PoseFit& fitted, bool searched) {
  Findings findings;
  if (are_too_few(fitted)) return findings;
  if (!is_credible(fitted, scale_mm_)) {
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
