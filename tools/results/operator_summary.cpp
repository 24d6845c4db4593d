#include "tools/results/operator_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "tools/results/left_out_lines.hpp"
#include "tools/results/optimum_lines.hpp"
#include "tools/results/words.hpp"
#include "tools/results/zone_lines.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kListed = 10;

/// How a list goes on of which kListed are told.
std::string and_more(std::size_t count) {
  return count > kListed ? fmt::format(" and {} more", count - kListed) : std::string();
}

/// How far a point is off and at which radius, where the foot is known.
std::string where(const Result& result, const ResultPoint& point) {
  std::string text = fmt::format("{:+.3f} {} (unfitted {:+.3f})", result.in_units(point.distance), result.units,
                                 result.in_units(point.before));
  if (point.foot && result.tip_radius > 0.0)
    text += fmt::format(" at r/R {:.2f}", result.axis.radius_of(*point.foot) / result.tip_radius);
  return text;
}

std::string_view what_to_do(const ResultPoint& point) {
  return point.action == Action::none ? "beyond the edge of the design" : word_of(point.action);
}

std::string region_line(const Result& result, Region region, const char* name) {
  std::size_t out = 0;
  std::optional<ResultPoint> worst;
  for (const ResultPoint& point : result.points) {
    if (point.region != region || point.state != PointState::out) continue;
    ++out;
    if (!worst || std::abs(point.distance) > std::abs(worst->distance)) worst = point;
  }
  if (!worst) return fmt::format("no {} point out\n", name);
  return fmt::format("{} {} {} out; worst {}, {}\n", out, name, out == 1 ? "point" : "points", where(result, *worst),
                     what_to_do(*worst));
}

std::string worst_list(const Result& result) {
  std::vector<ResultPoint> worst;  // the worst ones first; of points that are as bad, the earlier
  std::size_t out = 0;
  for (const ResultPoint& point : result.points) {
    if (point.state != PointState::out || point.region != Region::leading_edge) continue;
    ++out;
    const auto place = std::ranges::upper_bound(worst, std::abs(point.distance), std::greater(),
                                                [](const ResultPoint& p) { return std::abs(p.distance); });
    worst.insert(place, point);
    if (worst.size() > kListed) worst.pop_back();
  }
  std::string text;
  for (const ResultPoint& point : worst) {
    text += fmt::format("  point {:>5}  {:<4}  {}  (patch {}, u {:.4f}, v {:.4f})\n", point.sequence,
                        word_of(point.action), where(result, point), point.patch, point.u, point.v);
  }
  return out > kListed ? text + " " + and_more(out) + "\n" : text;
}

/// "3 suspected outliers (beyond 3.9 sigma, sigma = 0.01 mm): 18 (+3.001 mm, +20.1) and 2 more"
std::string outlier_line(const Result& result) {
  const Outliers& outliers = result.outliers;
  if (outliers.points.empty()) return "";
  std::string text = fmt::format("{} suspected {} (beyond {:.1f} sigma, sigma = {:.4g} {}):", outliers.points.size(),
                                 outliers.points.size() == 1 ? "outlier" : "outliers", outliers.limit,
                                 result.in_units(outliers.scale), result.units);
  for (std::size_t k = 0; k < std::min(outliers.points.size(), kListed); ++k) {
    const Outlier& p = outliers.points[k];
    text += fmt::format("{} {} ({:+.3f} {}, {:+.1f})", k == 0 ? "" : ",", p.sequence, result.in_units(p.distance),
                        result.units, p.studentized);
  }
  return text + and_more(outliers.points.size()) + "\n";
}

/// "A robust fit judges 34 points otherwise: 12, 13 and 32 more".
std::string robust_line(const Result& result) {
  const std::vector<std::uint32_t>& points = result.judged_otherwise;
  if (points.empty()) return "";
  const auto told = static_cast<std::ptrdiff_t>(std::min(points.size(), kListed));
  return fmt::format(
      "A robust fit judges {} {} otherwise: {}{}; defects that lie together draw a least-squares fit towards "
      "themselves: compare with --loss tukey\n",
      points.size(), points.size() == 1 ? "point" : "points", fmt::join(points.begin(), points.begin() + told, ", "),
      and_more(points.size()));
}

/// Settings that a reader of the figures must know, and the points that do not belong to the others.
std::string fit_remarks(const Result& result) {
  std::string text;
  if (!result.locked.empty()) text += fmt::format("Locked at the start value: {}\n", fmt::join(result.locked, ", "));
  if (result.loss) {
    text += fmt::format("Robust loss {}, standard deviation of good points {:.4g} {}\n", result.loss->name,
                        result.in_units(result.loss->scale), result.units);
  }
  return text + outlier_line(result) + robust_line(result);
}

/// ", 6 of 6 degrees of freedom determined"; empty where that is not known.
std::string determined(const Result& result) {
  if (!result.details) return "";
  return fmt::format(", {} of {} degrees of freedom determined", result.details->determined, result.details->free);
}

std::string fit_lines(const Result& result) {
  const EulerAngles e = euler_angles(result.pose.rotation);
  const Vec3 t = result.pose.translation / result.mm_per_unit;
  return fmt::format(
      "Fit {}: {} of {} points{}, rms {:.4f} {} (before {:.4f} {})\n"
      "Pose: tx {:.5f} ty {:.5f} tz {:.5f} {}; psi {:.7f} theta {:.7f} phi {:.7f} rad\n",
      result.status, result.all.count, result.points.size(), determined(result), result.in_units(result.all.rms_after),
      result.units, result.in_units(result.all.rms_before), result.units, t[0], t[1], t[2], result.units, e.psi,
      e.theta, e.phi);
}

/// The word on the blade, then every reason.
std::string verdict_lines(const Result& result) {
  std::string text = fmt::format("Verdict: {}\n", word_of(result.verdict.state));
  for (const VerdictReason& reason : result.verdict.reasons)
    text += fmt::format("  {}: {}\n", word_of(reason.code), reason.text);
  return text;
}

/// "simple", or the rule with what it rests on.
std::string decision_line(const Result& result) {
  const ResultVerdict& verdict = result.verdict;
  if (verdict.decision == DecisionRule::simple) return "";
  return fmt::format("Decision: guarded (ISO 14253-1), in or out only beyond U = {:g} u\n", verdict.coverage_factor);
}

/// The points of the leading edge, and those that are not judged.
std::string point_lines(const Result& result) {
  std::string text;
  const RegionDistances& edge = result.leading_edge;
  if (edge.count > 0) {
    text += fmt::format("Leading edge: {} points, rms {:.4f} {}, largest {:.4f} {}\n", edge.count,
                        result.in_units(edge.rms_after), result.units, result.in_units(edge.max_after), result.units);
  }
  return text + left_out_lines(result);
}

std::string tolerance_lines(const Result& result) {
  const auto& details = result.details;
  const double edge = details ? details->leading_edge_tolerance : result.leading_edge.tolerance;
  const double rest = details ? details->rest_tolerance : result.rest.tolerance;
  const bool zoned = !result.zones.empty(), edge_judged = !result.boxes.empty() && std::isfinite(edge);
  const auto allowed = [&](double mm) {
    return std::isfinite(mm) ? fmt::format("{:.3f} {}", result.in_units(mm), result.units) : std::string("none");
  };
  std::string text = zoned ? zone_lines(result)
                           : fmt::format("Tolerance: leading edge {}, rest of blade {}\n",
                                         edge_judged ? allowed(edge) : "none", allowed(rest));
  text += decision_line(result);
  if (zoned || edge_judged) text += region_line(result, Region::leading_edge, "leading-edge") + worst_list(result);
  if (zoned || std::isfinite(rest)) text += region_line(result, Region::rest, "other");
  return text;
}

/// "Radii: from the design's x axis, R 152.4 mm (--axis names another)".
std::string radius_line(const Result& result) {
  if (!(result.tip_radius > 0.0)) return "";
  const ShaftAxis& axis = result.axis;
  constexpr std::string_view kNames = "xyz";
  std::string name;
  for (int k = 0; k < 3; ++k) {
    if (axis.point.isZero() && axis.direction == Vec3(Vec3::Unit(k)))
      name = fmt::format("the design's {} axis", kNames[static_cast<std::size_t>(k)]);
  }
  if (name.empty()) {
    const Vec3 point = axis.point / result.mm_per_unit, &d = axis.direction;
    name = fmt::format("the axis through ({:g}, {:g}, {:g}) along ({:g}, {:g}, {:g})", point[0], point[1], point[2],
                       d[0], d[1], d[2]);
  }
  return fmt::format("Radii: from {}, R {}; --axis names another\n", name, length_text(result, result.tip_radius));
}

}  // namespace

std::string operator_summary(const Result& result) {
  const bool decided = result.verdict.fit_decided();
  std::string text = verdict_lines(result);
  for (const std::string& note : result.notes) text += note + "\n";
  text += fit_lines(result);
  if (decided) text += optimum_lines(result);
  text += fit_remarks(result) + point_lines(result) + radius_line(result);
  return decided ? text + tolerance_lines(result) : text;
}

}  // namespace bladefit
