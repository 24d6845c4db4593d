#include "tools/batch/fit_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/localizer/check_config.hpp"
#include "drivers/text/units.hpp"
#include "tools/batch/auto_zone.hpp"
#include "tools/batch/edge_zone.hpp"
#include "tools/batch/side_check.hpp"
#include "tools/batch/start_pairs.hpp"
#include "tools/batch/zone_plan.hpp"
#include "tools/design/blade_choice.hpp"

namespace bladefit {
namespace {

void plan_units(const FitSettings& settings, const DesignImage& design, FitPlan& plan) {
  const bool inch_design = design.header().design_unit == static_cast<std::uint32_t>(DesignUnit::inch);
  const Unit unit = settings.units.value_or(inch_design ? Unit::inch : Unit::mm);
  plan.units = word_of(unit);
  plan.mm_per_unit = mm_per_unit(unit);
  plan.points = {unit, settings.units, settings.columns.value_or(""), Directions::normalised};
}

/// The box lies outside of the window, so that no point of it is used.
bool beyond_window(const ParameterBox& box, const LocalizerConfig& fit) {
  return box.u_max < fit.window_low || box.u_min > fit.window_high || box.v_max < fit.window_low ||
         box.v_min > fit.window_high;
}

void check_tolerances(const FitSettings& settings, const FitPlan& plan) {
  const LocalizerConfig& fit = plan.localizer;
  const ToleranceMap& map = fit.tolerance;
  const double unit = plan.mm_per_unit;
  const double edge = settings.tolerance ? settings.tolerance->in_units(unit) : 0;
  const double rest = settings.rest_tolerance ? settings.rest_tolerance->in_units(unit) : 0;
  const bool both = settings.tolerance && settings.rest_tolerance;
  if (both && rest < edge) {
    throw ToolError(
        fmt::format("--rest-tolerance {:g}: is below --tolerance {:g}; the leading edge is the tighter one: "
                    "exchange the two, or correct one",
                    rest, edge));
  }
  if (settings.ratio && both && fit.mode != FitMode::min_tolerance && rest != *settings.ratio * edge) {
    throw ToolError(fmt::format("--ratio {:g} and --rest-tolerance {:g}: both give the rest tolerance; leave one out",
                                *settings.ratio, rest));
  }
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    if (map.boxes[k].zone != 0 || !beyond_window(map.boxes[k], fit)) continue;
    throw ToolError(
        fmt::format("--leading-edge: zone {} lies outside of --window {:g}:{:g}, so that no point can fall in "
                    "it; widen the window or correct the zone",
                    k + 1, fit.window_low, fit.window_high));
  }
}

void check_decision(const FitSettings& settings) {
  if (settings.probe_uncertainty && settings.mpe)
    throw ToolError("--probe-uncertainty and --mpe: both give the uncertainty of the probe; leave one out");
  if (settings.least_points && *settings.least_points != std::floor(*settings.least_points))
    throw ToolError(fmt::format("--least-points {:g}: is not a whole number", *settings.least_points));
}

/// What the core lets pass but no user can have meant.
void check_choices(const FitSettings& settings, const FitPlan& plan) {
  const LocalizerConfig& fit = plan.localizer;
  if (fit.mode == FitMode::min_tolerance && fit.tolerance.box_count == 0 && fit.tolerance.zone_count == 0)
    throw ToolError("--mode min_tolerance: no leading edge is given; add --leading-edge, or use --mode minimax");
  if (fit.loss == Loss::none && settings.loss_scale)
    throw ToolError("--loss-scale: there is no loss; add --loss huber or tukey");
  check_tolerances(settings, plan);
  check_decision(settings);
}

/// A fault of the configuration in the words of the command line.
std::string explained(const ConfigFault& fault, const LocalizerConfig& fit, std::size_t patches) {
  const std::string_view field = fault.field;
  if (field == "tolerance.boxes.patch") {
    const auto wrong = std::ranges::find_if(fit.tolerance.boxes, [&](const auto& box) { return box.patch >= patches; });
    return fmt::format("--leading-edge: patch {} is not there: the design has {} patch(es), numbered from 0",
                       wrong->patch, patches);
  }
  if (field == "tolerance.rest_mm" && fit.tolerance.zone_count > 0) {
    return fmt::format(
        "--mode {}: nothing is allowed outside of the zones, where points count in the fit too; add --rest-tolerance",
        word_of(fit.mode));
  }
  if (field == "tolerance.rest_mm") {
    return "--mode constrained: no tolerance is given; add --tolerance, or use --mode min_tolerance to find the "
           "smallest one";
  }
  if (field == "ratio") {
    return fmt::format(
        "--rest-tolerance: it is {:g} times --tolerance; min_tolerance needs the wider one on the rest of the blade",
        fit.ratio);
  }
  if (field == "decision.rule") {
    return "--decision guarded: the uncertainty of the probe is not given; add --probe-uncertainty or --mpe";
  }
  if (field == "loss") return fmt::format("--loss {}: only for --mode least_squares; leave it out", word_of(fit.loss));
  return fmt::format("the fit's {} {}; correct the options", field, fault.reason);
}

void plan_start(const std::string& path, FitPlan& plan) {
  if (path == kSearchStart) {
    if (plan.localizer.locked != 0) {
      throw ToolError(
          "--start search: --lock keeps degrees of freedom of a start that is not known; leave one of them out");
    }
    plan.search_start = true;
    return;
  }
  const StartPairs pairs = read_start_pairs(path, plan.points);
  if (!pairs.note.empty()) plan.note += fmt::format("{}: {}\n", path, pairs.note);
  plan.localizer.start = pairs.pose;
  plan.note += fmt::format("Start: {} point pairs, rms {:.4g} {}, largest {:.4g} {} at {}\n", pairs.count,
                           pairs.rms_mm / plan.mm_per_unit, plan.units, pairs.worst_mm / plan.mm_per_unit, plan.units,
                           pairs.worst_name);
}

/// The axis in mm, and R.
void plan_radii(const FitSettings& settings, FitPlan& plan) {
  if (settings.axis) plan.axis = {settings.axis->point * plan.mm_per_unit, settings.axis->direction};
  if (settings.tip_radius) plan.tip_radius_mm = settings.tip_radius->in_mm(plan.mm_per_unit);
}

/// Distances as large as the blade judge nothing.
void check_sizes(const FitSettings& settings, const FitPlan& plan, double longest_mm) {
  using Given = std::pair<const char*, std::optional<Length>>;
  for (std::size_t k = 0; k < plan.zones.size(); ++k) {
    const ToleranceZone& zone = plan.localizer.tolerance.zones.at(k);
    if (zone.limits().farther() <= longest_mm) continue;
    throw ToolError(
        fmt::format("{}.{}: {:g} {} is more than the blade's longest side, {:.4g} {}; correct it or its unit",
                    zone_title(plan, k), zone.plus_mm > longest_mm ? kPlusKey : kMinusKey,
                    zone.limits().farther() / plan.mm_per_unit, plan.units, longest_mm / plan.mm_per_unit, plan.units));
  }
  for (const auto& [flag, length] : {Given{"--tolerance", settings.tolerance},
                                     {"--loss-scale", settings.loss_scale},
                                     {"--probe-uncertainty", settings.probe_uncertainty}}) {
    if (!length || length->in_mm(plan.mm_per_unit) <= longest_mm) continue;
    throw ToolError(fmt::format("{}: {:g} {} is more than the blade's longest side, {:.4g} {}; correct it or its unit",
                                flag, length->in_units(plan.mm_per_unit), plan.units, longest_mm / plan.mm_per_unit,
                                plan.units));
  }
}

/// A ball that is as large as the blade touches it nowhere in particular.
void check_probe(const FitPlan& plan, double longest_mm) {
  const double radius = plan.localizer.probe_radius_mm, most = 0.5 * longest_mm;
  if (radius <= most) return;
  throw ToolError(
      fmt::format("--probe-radius: a ball of radius {:g} {} is larger than the blade, whose longest side is "
                  "{:.4g} {}; correct the radius or its unit",
                  radius / plan.mm_per_unit, plan.units, 2.0 * most / plan.mm_per_unit, plan.units));
}

}  // namespace

std::vector<std::string> names_of_locked(std::uint8_t locked) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kDegreesOfFreedom.size(); ++k) {
    if ((locked >> k & 1U) != 0) names.emplace_back(kDegreesOfFreedom[k]);
  }
  return names;
}

std::string start_file_of(const FitSettings& settings) {
  const std::string start = settings.start.value_or("");
  return start == kSearchStart ? "" : start;
}

DesignChoice design_choice_of(const FitSettings& settings) {
  DesignChoice choice(settings.outward.value_or(OutwardOption::automatic),
                      settings.face.value_or(std::vector<std::string>()), settings.allow_missing.value_or(false));
  if (settings.blade) choice.blade = blade_number(*settings.blade);
  choice.axis = settings.axis;
  if (settings.units) choice.mm_per_unit = mm_per_unit(*settings.units);
  return choice;
}

FitPlan plan_fit(const FitSettings& settings, const DesignImage& design) {
  FitPlan plan;
  plan_units(settings, design, plan);
  apply_fit_options(settings, plan.mm_per_unit, plan.localizer);
  plan_radii(settings, plan);
  if (settings.zones) {
    plan_zones(settings, Surface(design), plan);
  } else {
    plan_auto_zones(settings, Surface(design), plan);
  }
  check_choices(settings, plan);
  const ToleranceMap& map = plan.localizer.tolerance;
  if (settings.tolerance && map.box_count == 0) {
    plan.note += fmt::format("no --leading-edge is given: the whole blade is held to the rest tolerance, {:g} {}\n",
                             map.rest_mm / plan.mm_per_unit, plan.units);
  }
  if (settings.start) plan_start(*settings.start, plan);
  const std::size_t patches = design.patches().size();
  if (const ConfigFault fault = check_config(plan.localizer, patches))
    throw ToolError(explained(fault, plan.localizer, patches));
  const Vec3 box = Vec3(design.header().box_max) - Vec3(design.header().box_min);
  check_probe(plan, box.maxCoeff());
  check_sizes(settings, plan, box.maxCoeff());
  check_outward(design, settings.outward.value_or(OutwardOption::automatic));
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    if (map.boxes.at(k).zone == 0) plan.note += zone_warning(Surface(design), map.boxes.at(k));
  }
  return plan;
}

}  // namespace bladefit
