#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tools/batch/batch_fit.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kListed = 10;

double radius(const Vec3& point) { return std::hypot(point[1], point[2]); }

/// Largest radius about the shaft axis x of the design's control points [mm].
double tip_radius(const DesignImage& design) {
  double largest = 0.0;
  const auto c = design.coefficients();
  for (std::size_t k = 0; k + 3 < c.size(); k += 4)
    largest = std::max(largest, std::hypot(c[k + 1], c[k + 2]) / c[k + 3]);
  return largest;
}

const char* word(Action action) { return action == Action::cut ? "cut" : "weld"; }

std::string where(const Verdict& v, double tip, const FitPlan& plan) {
  return fmt::format("{:+.3f} {} at r/R {:.2f}", v.foot.distance / plan.mm_per_unit, plan.units,
                     radius(v.foot.point) / tip);
}

std::string region_line(const FitResult& result, Region region, const char* name, double tip, const FitPlan& plan) {
  std::size_t out = 0;
  const Verdict* worst = nullptr;
  for (const Verdict& v : result.verdicts) {
    if (v.region != region || v.state != PointState::out) continue;
    ++out;
    if (worst == nullptr || std::abs(v.foot.distance) > std::abs(worst->foot.distance)) worst = &v;
  }
  if (worst == nullptr) return fmt::format("no {} point out\n", name);
  return fmt::format("{} {} {} out; worst {}, {}\n", out, name, out == 1 ? "point" : "points", where(*worst, tip, plan),
                     word(worst->action));
}

std::string worst_list(const FitResult& result, double tip, const FitPlan& plan) {
  std::vector<const Verdict*> out;
  for (const Verdict& v : result.verdicts) {
    if (v.state == PointState::out && v.region == Region::leading_edge) out.push_back(&v);
  }
  std::stable_sort(out.begin(), out.end(), [](const Verdict* a, const Verdict* b) {
    return std::abs(a->foot.distance) > std::abs(b->foot.distance);
  });
  std::string text;
  for (std::size_t k = 0; k < std::min(out.size(), kListed); ++k) {
    const Verdict& v = *out[k];
    text += fmt::format("  point {:>5}  {:<4}  {}  (patch {}, u {:.4f}, v {:.4f})\n", v.sequence, word(v.action),
                        where(v, tip, plan), v.foot.patch, v.foot.u, v.foot.v);
  }
  if (out.size() > kListed) text += fmt::format("  and {} more\n", out.size() - kListed);
  return text;
}

/// Settings that a reader of the figures must know, and the points that do not belong to the others.
std::string fit_remarks(const FitResult& result, const FitPlan& plan) {
  std::string text;
  if (plan.localizer.locked != 0)
    text += fmt::format("Locked at the start value: {}\n", fmt::join(names_of_locked(plan.localizer.locked), ", "));
  if (plan.localizer.loss != Loss::none) {
    text += fmt::format("Robust loss {}, standard deviation of good points {:.4g} {}\n",
                        word_of(plan.localizer.loss),
                        result.report.loss_scale_mm / plan.mm_per_unit, plan.units);
  }
  const AberrantPoints& aberrant = result.aberrant;
  if (aberrant.points.empty()) return text;
  text += fmt::format("{} {} not belong to the others (beyond {:.1f} standard deviations of {:.4g} {}):",
                      aberrant.points.size(), aberrant.points.size() == 1 ? "point does" : "points do", aberrant.limit,
                      aberrant.scale_mm / plan.mm_per_unit, plan.units);
  for (std::size_t k = 0; k < std::min(aberrant.points.size(), kListed); ++k) {
    const AberrantPoint& p = aberrant.points[k];
    text += fmt::format("{} {} ({:+.3f} {}, {:+.1f})", k == 0 ? "" : ",", p.sequence, p.distance_mm / plan.mm_per_unit,
                        plan.units, p.studentized);
  }
  return text + (aberrant.points.size() > kListed ? " ...\n" : "\n");
}

/// "points 12, 81 and 407".
std::string point_list(const Certificate& certificate) {
  std::string text = "points ";
  for (std::uint32_t k = 0; k < certificate.count; ++k) {
    const char* joint = k == 0 ? "" : k + 1 == certificate.count ? " and " : ", ";
    text += fmt::format("{}{}", joint, certificate.sequence.at(k));
  }
  return text;
}

/// How sure it is that no other pose is better, in words.
std::string other_starts(const FitReport& report) {
  if (report.further_starts == 0) return "";
  return fmt::format("; {} of {} further starts led to it, none to a better one", report.same_optimum,
                     report.further_starts);
}

/// Why no pose meets the tolerances, and how much wider they must be.
std::string infeasible_lines(const FitResult& result, const FitPlan& plan) {
  const ToleranceMap& tolerance = plan.localizer.tolerance;
  const bool one = one_tolerance(tolerance);
  const double wanted = one ? tolerance.rest_mm : tolerance.leading_edge_mm;
  const double least = least_widening(result.report, tolerance) * wanted;
  const auto length = [&](double mm) { return fmt::format("{:.6g} {}", mm / plan.mm_per_unit, plan.units); };
  return fmt::format(
      "Infeasible: {} cannot be brought within {} together; the least feasible {} tolerance is {}.\n"
      "Measure these points again, or widen the {}\n",
      point_list(result.report.certificate), length(wanted), one ? "rest" : "leading-edge", length(least),
      one ? fmt::format("rest tolerance by {}", length(least - wanted))
          : fmt::format("leading-edge tolerance by {} and the rest tolerance in the same ratio",
                        length(least - wanted)));
}

/// What the mode found, in words; empty in least squares.
std::string optimum_line(const FitResult& result, const FitPlan& plan) {
  const FitReport& report = result.report;
  const auto length = [&](double mm) { return fmt::format("{:.6g} {}", mm / plan.mm_per_unit, plan.units); };
  const double factor = report.tolerance_factor_mm;
  if (factor <= 0.0) return "";
  const std::string proof = fmt::format("Proof: {} cannot all come nearer (multipliers balance to {:.1e})\n",
                                        point_list(report.certificate), report.stationarity);
  switch (plan.localizer.mode) {
    case FitMode::minimax:
      return fmt::format("Largest distance: {}, the smallest found{}\n", length(factor), other_starts(report)) + proof;
    case FitMode::range:
      return fmt::format("Range of distances: {}, the smallest found{}\n", length(factor), other_starts(report));
    case FitMode::min_tolerance:
      return fmt::format("Smallest leading-edge tolerance that can be met: {} ({} elsewhere){}\n", length(factor),
                         length(plan.localizer.ratio * factor), other_starts(report)) +
             proof;
    case FitMode::constrained:
      return infeasible_lines(result, plan);
    case FitMode::least_squares:
      break;
  }
  return "";
}

}  // namespace

std::string operator_summary(const FitResult& result, const FitPlan& plan, const DesignImage& design) {
  const double unit = plan.mm_per_unit, tip = tip_radius(design);
  const EulerAngles e = euler_angles(result.report.pose.rotation);
  const Vec3 t = result.report.pose.translation / unit;
  std::string text;
  text += fmt::format("Fit {}: {} of {} points, {} degrees of freedom determined, rms {:.4f} {} (before {:.4f} {})\n",
                      result.status, result.all.count, result.verdicts.size(), result.report.determined,
                      result.all.rms_after / unit, plan.units, result.all.rms_before / unit, plan.units);
  text += fmt::format("Pose: tx {:.5f} ty {:.5f} tz {:.5f} {}; psi {:.7f} theta {:.7f} phi {:.7f} rad\n", t[0], t[1],
                      t[2], plan.units, e.psi, e.theta, e.phi);
  text += optimum_line(result, plan) + fit_remarks(result, plan);
  if (result.report.unproven > 0)
    text += fmt::format("{} feet could not be proven the nearest: do not rely on this fit\n", result.report.unproven);
  if (result.leading_edge.count > 0) {
    text +=
        fmt::format("Leading edge: {} points, rms {:.4f} {}, largest {:.4f} {}\n", result.leading_edge.count,
                    result.leading_edge.rms_after / unit, plan.units, result.leading_edge.max_after / unit, plan.units);
  }
  const std::size_t rejected =
      static_cast<std::size_t>(std::count_if(result.verdicts.begin(), result.verdicts.end(),
                                             [](const Verdict& v) { return v.state == PointState::rejected; }));
  if (rejected > 0)
    text += fmt::format("{} points do not count: foot on an edge of the design or outside the window\n", rejected);
  const ToleranceMap& tolerance = plan.localizer.tolerance;
  const auto allowed = [&](double mm) {
    return std::isfinite(mm) ? fmt::format("{:.3f} {}", mm / unit, plan.units) : std::string("none");
  };
  text +=
      fmt::format("Tolerance: leading edge {}, elsewhere {}\n",
                  tolerance.box_count > 0 ? allowed(tolerance.leading_edge_mm) : "none", allowed(tolerance.rest_mm));
  if (std::isfinite(tolerance.leading_edge_mm) && tolerance.box_count > 0)
    text += region_line(result, Region::leading_edge, "leading-edge", tip, plan) + worst_list(result, tip, plan);
  if (std::isfinite(tolerance.rest_mm)) text += region_line(result, Region::rest, "other", tip, plan);
  return text;
}

}  // namespace bladefit
