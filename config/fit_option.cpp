#include "config/fit_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bladefit {
namespace {

using S = FitSettings;
using C = LocalizerConfig;

constexpr LengthOption length_above_0(std::optional<Length> S::*value) { return {value, true}; }

/// The zones that are boxes; the others depend on the design.
void apply_boxes(const S& s, double /*mm*/, C& c) {
  c.tolerance.box_count = 0;
  for (const EdgeZone& zone : *s.leading_edge) {
    if (zone.reach == 0) c.tolerance.boxes.at(c.tolerance.box_count++) = zone.box;
  }
}

/// `ratio` has two uses here: it gives the rest tolerance where that is not given, and it is the ratio that the mode
/// min_tolerance holds. In the C interface, which takes both tolerances as lengths, it has the second one only.
void apply_tolerance(const S& s, double mm, C& c) {
  c.tolerance.leading_edge_mm = s.tolerance->in_mm(mm);
  c.tolerance.rest_mm = s.ratio.value_or(c.ratio) * c.tolerance.leading_edge_mm;
}

/// Two tolerances give the ratio of min_tolerance where it is not given itself.
void apply_rest_tolerance(const S& s, double mm, C& c) {
  c.tolerance.rest_mm = s.rest_tolerance->in_mm(mm);
  const bool wanted = c.mode == FitMode::min_tolerance && s.tolerance && !s.ratio;
  if (wanted) c.ratio = c.tolerance.rest_mm / c.tolerance.leading_edge_mm;
}

void apply_window(const S& s, double /*mm*/, C& c) {
  c.window_low = s.window->low;
  c.window_high = s.window->high;
}

void apply_mpe(const S& s, double /*mm*/, C& c) {
  constexpr double kMmPerMicrometre = 1e-3;
  // A largest error is taken for the limit of a rectangular distribution (ISO 14253-2).
  c.decision.probe_mm = s.mpe->constant_um * kMmPerMicrometre / std::sqrt(3.0);
  c.decision.probe_per_mm =
      s.mpe->length_mm_per_um > 0.0 ? kMmPerMicrometre / (s.mpe->length_mm_per_um * std::sqrt(3.0)) : 0.0;
}

// An option is applied after those above it.
constexpr std::array kOptions{
    FitOption{"mode", ChoiceOption<FitMode>{&S::mode, kFitModeWords},
              [](const S& s, double, C& c) { c.mode = *s.mode; }, kFitModeHelp, "\"least_squares\"", true},
    FitOption{"leading_edge", ZonesOption{&S::leading_edge}, apply_boxes,
              "leading-edge region: [PATCH:]u:0.4:0.6 or [PATCH:]v:0.4:0.6, a box between two isoparameter lines; "
              "PATCH counts from 0; or auto:5mm, auto:3%: as far along the sections on either side of the ridge of "
              "greatest curvature, % of the chord; may be several",
              "[\"0:u:0.4:0.6\"]", true},
    FitOption{"leading_edge_near", PlaceOption{&S::leading_edge_near}, nullptr,
              "x,y,z in units: with auto, the ridge nearest to this place of the design is the leading edge",
              "\"12.5,-40,85\""},
    FitOption{"rotation", ChoiceOption<Rotation>{&S::rotation, kRotationWords}, nullptr,
              "right or left: with auto, the leading edge is the ridge that goes first where the propeller turns right "
              "(clockwise) or left, seen along the direction of the axis",
              "\"right\""},
    FitOption{"tolerance", length_above_0(&S::tolerance), apply_tolerance,
              "distance allowed at the leading edge, in units", "0.1", true},
    FitOption{"rest_tolerance", length_above_0(&S::rest_tolerance), apply_rest_tolerance,
              "distance allowed on the rest of the blade, in units (default: ratio times that at the leading edge)",
              "1.0"},
    FitOption{"ratio", NumberOption{&S::ratio, 1, kLargestGiven}, [](const S& s, double, C& c) { c.ratio = *s.ratio; },
              "rest tolerance / leading-edge tolerance (default 10): gives the rest tolerance where that is not given, "
              "and is the ratio that min_tolerance holds",
              "10.0", true},
    FitOption{"transition", NumberOption{&S::transition, 0, 1},
              [](const S& s, double, C& c) { c.tolerance.transition = *s.transition; },
              "width [patch parameter] over which the tolerance rises outside the leading-edge region (default 0)",
              "0.0", true},
    FitOption{"window", WindowOption{&S::window}, apply_window,
              "use only points whose foot before the fit has a <= u,v <= b, for example 0.05:0.95", "\"0.05:0.95\""},
    FitOption{
        "outward", OutwardKind{&S::outward}, nullptr,
        "+, - or auto: side away from the material, that to which the faces look (of Su x Sv, where the file says "
        "nothing else) or the other (default auto: by the shape); or a side for each face, by number, name or "
        "pattern: SUCTION:+,3:-",
        "\"auto\""},
    FitOption{"face", NamesOption{&S::face}, nullptr,
              "a face of the design to be used, by its number in compile with list, its name or a pattern such as "
              "BLADE*; once for each (default: all)",
              "[\"SUCTION\", \"PRESSURE\"]"},
    FitOption{
        "blade", NumberOption{&S::blade, 1, 100}, nullptr,
        "the one blade of a whole propeller to be used, by its number in compile with list, which counts about the "
        "axis (default: all; the start pose decides which of them was probed)",
        "1"},
    FitOption{"allow_missing", FlagOption{&S::allow_missing}, nullptr,
              "go on without the faces of the design that cannot be read", "true"},
    FitOption{"probe_radius", LengthOption{&S::probe_radius},
              [](const S& s, double mm, C& c) { c.probe_radius_mm = s.probe_radius->in_mm(mm); },
              "points are centres of a ball of this radius, in units (default 0)", "0.0", true},
    FitOption{
        "units", ChoiceOption<Unit>{&S::units, kUnitWords}, nullptr,
        "mm, in, cm or m: of all lengths that are given without one (0.1mm has one), and of those written (default: "
        "those of the design file; points whose file says its unit with the names of its columns are in that)",
        "\"mm\""},
    FitOption{"columns", ColumnsOption{&S::columns}, nullptr,
              "what the columns of the points file are where its first line does not say it: x, y, z and optionally i, "
              "j, k, path, weight in their order, - for one that is not used",
              "\"-,x,y,z\""},
    FitOption{"regions", ChoiceOption<RegionPolicy>{&S::regions, kRegionPolicyWords},
              [](const S& s, double, C& c) { c.regions = *s.regions; },
              "follow (default): a point's region is that of its present foot; fixed: of its foot at the least-squares "
              "solution, as in the thesis. In a least-squares fit the two agree",
              "\"follow\"", true},
    FitOption{"edges", ChoiceOption<EdgePolicy>{&S::edges, kEdgePolicyWords},
              [](const S& s, double, C& c) { c.edges = *s.edges; },
              "skip (default) or use points whose foot is on an edge of the design", "\"skip\"", true},
    FitOption{"lock", LocksOption{&S::lock}, [](const S& s, double, C& c) { c.locked = *s.lock; },
              "tx,ty,tz,rx,ry,rz: degrees of freedom that keep their start value, for example tx,rz; rx, ry, rz hold "
              "the angles psi, theta, phi of C = Rx(psi) Ry(theta) Rz(phi)",
              "\"tx,rz\""},
    FitOption{"loss", ChoiceOption<Loss>{&S::loss, kLossWords}, [](const S& s, double, C& c) { c.loss = *s.loss; },
              "none (default), huber or tukey: robust least squares, in which outliers pull less (huber) or not at all "
              "(tukey)",
              "\"none\"", true},
    FitOption{"loss_scale", length_above_0(&S::loss_scale),
              [](const S& s, double mm, C& c) { c.loss_scale_mm = s.loss_scale->in_mm(mm); },
              "standard deviation of good points, in units (default: 1.4826 times the median distance)", "0.05"},
    FitOption{"start", PathOption{&S::start, kSearchStart}, nullptr,
              "CSV file of at least 3 point pairs, columns [name,]x,y,z,design_x,design_y,design_z in units: the pose "
              "that brings them together is where the fit starts; or the word search: localize finds the start from "
              "the points alone",
              "\"pairs.csv\""},
    FitOption{"ignore_approach", FlagOption{&S::ignore_approach},
              [](const S& s, double, C& c) { c.use_approach = !*s.ignore_approach; },
              "do not use the probing directions i,j,k, which choose the side of the blade", "false", true},
    FitOption{
        "decision", ChoiceOption<DecisionRule>{&S::decision, kDecisionRuleWords},
        [](const S& s, double, C& c) { c.decision.rule = *s.decision; },
        "simple (default): a distance is compared with its tolerance as it is; guarded: a point is in or out only "
        "where the expanded uncertainty leaves no doubt (ISO 14253-1:2017), else undecided; it needs the probe "
        "uncertainty or the mpe",
        "\"simple\""},
    FitOption{"probe_uncertainty", length_above_0(&S::probe_uncertainty),
              [](const S& s, double mm, C& c) { c.decision.probe_mm = s.probe_uncertainty->in_mm(mm); },
              "standard uncertainty of a distance that comes from the probe, in units", "0.002"},
    FitOption{
        "mpe", MpeOption{&S::mpe}, apply_mpe,
        "A+L/K of the machine's data sheet, for example 1.9+L/300: its largest permissible error is A micrometres "
        "and L/K, L in mm: here the distance of a point from the middle of the design. The standard uncertainty is "
        "taken as that error / sqrt(3)",
        "\"1.9+L/300\""},
    FitOption{"coverage_factor", NumberOption{&S::coverage_factor, 0, 10, true},
              [](const S& s, double, C& c) { c.decision.coverage_factor = *s.coverage_factor; },
              "k of the expanded uncertainty U = k u (default 2: some 95 %)", "2.0"},
    FitOption{"least_points", NumberOption{&S::least_points, 1, 1e6},
              [](const S& s, double, C& c) { c.tolerance.least_points = static_cast<std::uint32_t>(*s.least_points); },
              "judged points that each zone needs; with fewer the blade is not decided (default 1)", "1", false},
    FitOption{"axis", AxisOption{&S::axis}, nullptr,
              "axis of the shaft in the design, from which radii are measured: x (default), y, z, or x0,y0,z0,i,j,k, a "
              "point of it in units and its direction",
              "\"x\""},
    FitOption{"tip_radius", length_above_0(&S::tip_radius), nullptr,
              "R of r/R, in units (default: the greatest distance of the design's surface from the axis)", "152.4"},
};

}  // namespace

std::span<const FitOption> fit_options() { return kOptions; }

std::string flag_of(const FitOption& option) {
  std::string flag = fmt::format("--{}", option.key);
  std::ranges::replace(flag, '_', '-');
  return flag;
}

FitSettings merged(const FitSettings& flags, const FitSettings& file) {
  FitSettings out = flags;
  for (const FitOption& option : kOptions) {
    const auto fill = [&](const auto& kind) {
      if (!(out.*kind.value)) out.*kind.value = file.*kind.value;
    };
    std::visit(fill, option.kind);
  }
  if (!out.zones) out.zones = file.zones;
  return out;
}

void apply_fit_options(const FitSettings& settings, double mm_per_unit, LocalizerConfig& config) {
  for (const FitOption& option : kOptions) {
    const bool given = std::visit([&](const auto& kind) { return (settings.*kind.value).has_value(); }, option.kind);
    if (given && option.apply != nullptr) option.apply(settings, mm_per_unit, config);
  }
}

}  // namespace bladefit
