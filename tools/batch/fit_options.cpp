#include "tools/batch/fit_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>

#include "drivers/text/units.hpp"
#include "tools/batch/start_pairs.hpp"

namespace bladefit {
namespace {

/// CLI11 option that writes to a std::optional.
template <class T>
CLI::Option* add(CLI::App& command, const std::string& name, std::optional<T>& target, const std::string& help) {
  return command.add_option_function<T>(
      name, [&target](const T& value) { target = value; }, help);
}

void take(const ConfigError& error) {
  if (error) throw ToolError(error.message);
}

double positive(double value, const char* option) {
  if (!(value > 0.0 && value <= kLargestSetting)) {
    throw ToolError(
        fmt::format("{}: {} is not a positive length; give one above 0, up to {}", option, value, kLargestSetting));
  }
  return value;
}

void plan_boxes(const FitSettings& settings, const DesignImage& design, ToleranceMap& map) {
  if (!settings.leading_edge) return;
  if (settings.leading_edge->size() > ToleranceMap::kMaxBoxes) {
    throw ToolError(fmt::format("--leading-edge: {} boxes, at most {} are possible", settings.leading_edge->size(),
                                ToleranceMap::kMaxBoxes));
  }
  for (const std::string& text : *settings.leading_edge) {
    ParameterBox box;
    take(parse_leading_edge(text, box));
    if (box.patch >= design.patches().size()) {
      throw ToolError(fmt::format("--leading-edge {}: the design has {} patch(es), numbered from 0", text,
                                  design.patches().size()));
    }
    map.boxes[map.box_count++] = box;
  }
}

void plan_tolerance(const FitSettings& settings, FitPlan& plan) {
  ToleranceMap& map = plan.localizer.tolerance;
  const double ratio = settings.ratio.value_or(10.0);
  if (!(ratio >= 1.0 && ratio <= kLargestSetting)) {
    throw ToolError(
        fmt::format("--ratio: {} is no ratio; give a number from 1 to {}, since the rest has the wider tolerance",
                    ratio, kLargestSetting));
  }
  if (settings.tolerance) {
    map.leading_edge_mm = positive(*settings.tolerance, "--tolerance") * plan.mm_per_unit;
    map.rest_mm = ratio * map.leading_edge_mm;
  }
  if (settings.rest_tolerance) map.rest_mm = positive(*settings.rest_tolerance, "--rest-tolerance") * plan.mm_per_unit;
  plan.localizer.ratio = ratio;
  // The tolerances give the ratio of min_tolerance where it is not given itself.
  if (settings.tolerance && settings.rest_tolerance && !settings.ratio) {
    plan.localizer.ratio = map.rest_mm / map.leading_edge_mm;
  }
  map.transition = settings.transition.value_or(0.0);
  if (!(map.transition >= 0.0) || map.transition > 1.0)
    throw ToolError(fmt::format("--transition: {} is not a width in patch parameters, 0 to 1", map.transition));
  if (settings.tolerance && map.box_count == 0) {
    plan.note += fmt::format("no --leading-edge is given: the whole blade is held to the rest tolerance, {:g} {}\n",
                             map.rest_mm / plan.mm_per_unit, plan.units);
  }
}

constexpr std::array<std::pair<const char*, FitMode>, 5> kModes{{{"least_squares", FitMode::least_squares},
                                                                 {"minimax", FitMode::minimax},
                                                                 {"range", FitMode::range},
                                                                 {"min_tolerance", FitMode::min_tolerance},
                                                                 {"constrained", FitMode::constrained}}};

void plan_mode(const FitSettings& settings, FitPlan& plan) {
  plan.mode = settings.mode.value_or("least_squares");
  const auto mode = std::find_if(kModes.begin(), kModes.end(), [&](const auto& m) { return plan.mode == m.first; });
  if (mode == kModes.end()) {
    throw ToolError(
        fmt::format("--mode {}: give least_squares, minimax, range, min_tolerance or constrained", plan.mode));
  }
  plan.localizer.mode = mode->second;
  const std::string regions = settings.regions.value_or("follow");
  if (regions != "follow" && regions != "fixed")
    throw ToolError(fmt::format("--regions {}: give follow or fixed", regions));
  plan.localizer.regions = regions == "fixed" ? RegionPolicy::fixed : RegionPolicy::follow;
  const std::string edges = settings.edges.value_or("skip");
  if (edges != "skip" && edges != "use") throw ToolError(fmt::format("--edges {}: give skip or use", edges));
  plan.localizer.edges = edges == "use" ? EdgePolicy::use : EdgePolicy::skip;
  if (settings.lock) {
    if (const ConfigError error = parse_lock(*settings.lock, plan.localizer.locked))
      throw ToolError("--lock: " + error.message);
  }
}

void plan_loss(const FitSettings& settings, FitPlan& plan) {
  const std::string loss = settings.loss.value_or("none");
  if (loss != "none" && loss != "huber" && loss != "tukey")
    throw ToolError(fmt::format("--loss {}: give none, huber or tukey", loss));
  if (loss == "none") {
    if (settings.loss_scale) throw ToolError("--loss-scale: there is no loss; add --loss huber or tukey");
    return;
  }
  if (plan.localizer.mode != FitMode::least_squares)
    throw ToolError(fmt::format("--loss {}: only for --mode least_squares; leave it out", loss));
  plan.localizer.loss = loss == "huber" ? Loss::huber : Loss::tukey;
  if (settings.loss_scale)
    plan.localizer.loss_scale_mm = positive(*settings.loss_scale, "--loss-scale") * plan.mm_per_unit;
}

/// What a mode needs beside its name.
void check_mode(const FitPlan& plan) {
  const LocalizerConfig& fit = plan.localizer;
  if (fit.mode == FitMode::constrained && !std::isfinite(fit.tolerance.rest_mm)) {
    throw ToolError(
        "--mode constrained: no tolerance is given; add --tolerance, or use --mode min_tolerance to find the smallest "
        "one");
  }
  if (fit.mode != FitMode::min_tolerance) return;
  if (fit.tolerance.box_count == 0) {
    throw ToolError("--mode min_tolerance: no leading edge is given; add --leading-edge, or use --mode minimax");
  }
  if (fit.ratio < 1.0) {
    throw ToolError(fmt::format(
        "--rest-tolerance: it is {:g} times --tolerance; min_tolerance needs the wider one elsewhere", fit.ratio));
  }
}

void plan_start(const std::string& path, FitPlan& plan) {
  const StartPairs pairs = read_start_pairs(path, plan.mm_per_unit);
  plan.localizer.start = pairs.pose;
  plan.note += fmt::format("Start: {} point pairs, rms {:.4g} {}, largest {:.4g} {} at {}\n", pairs.count,
                           pairs.rms_mm / plan.mm_per_unit, plan.units, pairs.worst_mm / plan.mm_per_unit, plan.units,
                           pairs.worst_name);
}

void plan_units(const FitSettings& settings, const DesignImage& design, FitPlan& plan) {
  const bool inch_design = design.header().design_unit == static_cast<std::uint32_t>(DesignUnit::inch);
  plan.units = settings.units.value_or(inch_design ? "in" : "mm");
  if (plan.units != "mm" && plan.units != "in") throw ToolError(fmt::format("--units {}: give mm or in", plan.units));
  plan.mm_per_unit = plan.units == "in" ? kMmPerInch : 1.0;
}

}  // namespace

void add_fit_options(CLI::App& command, FitSettings& flags) {
  const std::string group = "Fit";
  add(command, "--mode", flags.mode,
      "what the fit minimises: least_squares (default): the sum of squared distances; minimax: the largest distance; "
      "range: largest less smallest signed distance; min_tolerance: the leading-edge tolerance that can just be met, "
      "with --ratio times it elsewhere; constrained: the sum of squares with every distance within its tolerance")
      ->group(group);
  add(command, "--leading-edge", flags.leading_edge,
      "[PATCH:]u:0.4:0.6 or v:...: leading-edge region between two isoparameter lines; may be repeated")
      ->group(group)
      ->allow_extra_args(false);
  add(command, "--tolerance", flags.tolerance, "distance allowed at the leading edge, in --units")->group(group);
  add(command, "--rest-tolerance", flags.rest_tolerance,
      "distance allowed elsewhere (default: ratio times --tolerance)")
      ->group(group);
  add(command, "--ratio", flags.ratio, "rest tolerance / leading-edge tolerance (default 10)")->group(group);
  add(command, "--transition", flags.transition,
      "width [patch parameter] over which the tolerance rises outside the region")
      ->group(group);
  add(command, "--window", flags.window,
      "use only points whose foot before the fit has a <= u,v <= b, for example 0.05:0.95")
      ->group(group);
  add(command, "--outward", flags.outward, "+, - or auto: side of the surface away from the material (default auto)")
      ->group(group);
  add(command, "--probe-radius", flags.probe_radius,
      "points are centres of a ball of this radius, in --units (default 0)")
      ->group(group);
  add(command, "--units", flags.units, "mm or in: of all lengths given and written (default: those of the design file)")
      ->group(group);
  add(command, "--regions", flags.regions,
      "follow (default): a point's region is that of its present foot; fixed: of its foot at the least-squares "
      "solution, as in the thesis. In a least-squares fit the two agree")
      ->group(group);
  add(command, "--edges", flags.edges, "skip (default) or use points whose foot is on an edge of the design")
      ->group(group);
  add(command, "--lock", flags.lock,
      "tx,ty,tz,rx,ry,rz: degrees of freedom that keep their start value, for example tx,rz; rx, ry, rz hold the "
      "angles psi, theta, phi of C = Rx(psi) Ry(theta) Rz(phi)")
      ->group(group);
  add(command, "--loss", flags.loss,
      "none (default), huber or tukey: robust least squares, in which outliers pull less (huber) or not at all (tukey)")
      ->group(group);
  add(command, "--loss-scale", flags.loss_scale,
      "standard deviation of good points, in --units (default: 1.4826 times the median distance)")
      ->group(group);
  add(command, "--start", flags.start,
      "CSV file of at least 3 point pairs, columns [name,]x,y,z,design_x,design_y,design_z in --units: the pose that "
      "brings them together is where the fit starts")
      ->group(group);
  command
      .add_flag_callback(
          "--ignore-approach", [&flags] { flags.ignore_approach = true; }, "do not use the probing directions i,j,k")
      ->group(group);
}

std::vector<std::string> names_of_locked(std::uint8_t locked) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kDegreesOfFreedom.size(); ++k) {
    if ((locked >> k & 1U) != 0) names.emplace_back(kDegreesOfFreedom[k]);
  }
  return names;
}

FitSettings merged(const FitSettings& flags, const FitSettings& file) {
  using S = FitSettings;
  constexpr std::tuple members(&S::mode, &S::leading_edge, &S::tolerance, &S::rest_tolerance, &S::ratio, &S::transition,
                               &S::window, &S::outward, &S::probe_radius, &S::units, &S::regions, &S::edges, &S::lock,
                               &S::loss, &S::loss_scale, &S::start, &S::ignore_approach);
  FitSettings out = flags;
  const auto fill = [&](auto member) {
    if (!(out.*member)) out.*member = file.*member;
  };
  std::apply([&](auto... member) { (fill(member), ...); }, members);
  return out;
}

OutwardOption outward_of(const FitSettings& settings) { return parse_outward(settings.outward.value_or("auto")); }

FitPlan plan_fit(const FitSettings& settings, const DesignImage& design) {
  FitPlan plan;
  plan_mode(settings, plan);
  plan_units(settings, design, plan);
  plan_boxes(settings, design, plan.localizer.tolerance);
  plan_tolerance(settings, plan);
  check_mode(plan);
  plan_loss(settings, plan);
  if (settings.start) plan_start(*settings.start, plan);
  const double radius = settings.probe_radius.value_or(0.0);
  if (!(radius >= 0.0 && radius <= kLargestSetting)) {
    throw ToolError(
        fmt::format("--probe-radius: {} is not a radius; give 0 or more, up to {}", radius, kLargestSetting));
  }
  plan.localizer.probe_radius_mm = radius * plan.mm_per_unit;
  plan.localizer.use_approach = !settings.ignore_approach.value_or(false);
  if (settings.window) {
    ParameterWindow window;
    take(parse_window(*settings.window, window));
    plan.localizer.window_low = window.low;
    plan.localizer.window_high = window.high;
  }
  return plan;
}

}  // namespace bladefit
