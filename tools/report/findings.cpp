#include "tools/report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/report/report_text.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

std::string place_of(const Result& result, const ResultPoint& point) {
  return fmt::format("point {}, patch {}, u {:.4f}, v {:.4f}, radius {:.2f} {}", point.sequence, point.patch, point.u,
                     point.v, result.in_units(radius_of(result, point)), result.units);
}

/// Where the feet of points lie that are not judged.
std::string where_left_out(const Result& result, std::uint32_t rejected) {
  const auto count = [&result](LeftOut reason) {
    return std::count_if(result.points.begin(), result.points.end(),
                         [reason](const ResultPoint& point) { return point.left_out == reason; });
  };
  const auto window = count(LeftOut::window), edge = count(LeftOut::edge);
  if (window == rejected) return "outside the window before the fit";
  if (edge == rejected) return "on an outer edge of the design";
  if (window + edge == rejected)
    return fmt::format("outside the window before the fit ({}) or on an outer edge of the design ({})", window, edge);
  return "on an edge of the design or outside the window";
}

std::string points_sentence(const Result& result) {
  const std::uint32_t rejected = rejected_points(result);
  if (rejected == 0) return fmt::format("{} measured, all of them judged.", counted(result.points.size(), "point"));
  return fmt::format("{} measured; {} not count, because the foot lies {}.", counted(result.points.size(), "point"),
                     rejected == 1 ? "1 does" : fmt::format("{} do", rejected), where_left_out(result, rejected));
}

std::string fit_sentence(const Result& result) {
  const LengthText text(result);
  return fmt::format("Fit ({}): {}; {} in it, RMS distance {} (before the fit {}), largest {}.", readable(result.mode),
                     readable(result.status), counted(result.all.count, "point"), text.with_unit(result.all.rms_after),
                     text.with_unit(result.all.rms_before), text.with_unit(result.all.max_after));
}

std::string out_sentence(const Result& result, const RegionFindings& found) {
  if (!found.worst_out) return "none is out.";
  const Action action = found.worst_out->action;
  const std::string beyond =
      found.beyond > 0 ? fmt::format(", {} beyond the edge of the design", found.beyond) : std::string();
  return fmt::format(
      "{} {} out: {} to cut, {} to weld{}. Worst: {}, {}; {}.", found.out(), found.out() == 1 ? "is" : "are", found.cut,
      found.weld, beyond, LengthText(result).with_sign_and_unit(found.worst_out->distance),
      action == Action::none ? "beyond the edge of the design" : word_of(action), place_of(result, *found.worst_out));
}

std::string region_sentence(const Result& result, Region region) {
  const bool leading_edge = region == Region::leading_edge;
  const RegionFindings found = findings_of(result, region);
  const double tolerance = judged_tolerance(result, region);
  std::string text =
      fmt::format("{}: {}, ", leading_edge ? "Leading edge" : "Rest of the blade", counted(found.points, "point"));
  if (result.zones.empty() && !std::isfinite(tolerance)) return text + "no tolerance was set: not judged.";
  text += result.zones.empty() ? fmt::format("tolerance ±{}; ", LengthText(result).with_unit(tolerance))
                               : std::string("judged by zone; ");
  text += out_sentence(result, found);
  if (found.pending > 0)
    text += fmt::format(" {} of them not decided, because the points do not determine the fit there.", found.pending);
  if (found.undecided > 0) text += fmt::format(" {} undecided.", counted(found.undecided, "point"));
  return text;
}

}  // namespace

RegionFindings findings_of(const Result& result, Region region) {
  RegionFindings found;
  for (const ResultPoint& point : result.points) {
    if (point.region != region || point.state == PointState::rejected) continue;
    ++found.points;
    if (point.state == PointState::pending) ++found.pending;
    if (point.state == PointState::undecided) ++found.undecided;
    if (point.state != PointState::out) continue;
    ++(point.action == Action::none ? found.beyond : point.distance > 0 ? found.cut : found.weld);
    if (!found.worst_out || std::abs(point.distance) > std::abs(found.worst_out->distance)) found.worst_out = point;
  }
  return found;
}

double judged_tolerance(const Result& result, Region region) {
  if (!result.zones.empty()) return std::numeric_limits<double>::infinity();
  if (result.mode != word_of(FitMode::min_tolerance))
    return (region == Region::leading_edge ? result.leading_edge : result.rest).tolerance;
  std::optional<double> widest;  // where a zone lies between the regions the rest's own is the widest
  for (const ResultPoint& point : result.points) {
    if (point.region == region && point.state != PointState::rejected)
      widest = std::max(widest.value_or(point.tolerance), point.tolerance);
  }
  return widest.value_or(std::numeric_limits<double>::infinity());
}

std::uint32_t rejected_points(const Result& result) {
  return static_cast<std::uint32_t>(
      std::count_if(result.points.begin(), result.points.end(),
                    [](const ResultPoint& point) { return point.state == PointState::rejected; }));
}

std::vector<ResultPoint> out_of_tolerance(const Result& result) {
  std::vector<ResultPoint> out;
  for (const ResultPoint& point : result.points) {
    if (point.state == PointState::out) out.push_back(point);
  }
  std::stable_sort(out.begin(), out.end(), [](const ResultPoint& a, const ResultPoint& b) {
    if (a.region != b.region) return a.region == Region::leading_edge;
    return std::abs(a.distance) > std::abs(b.distance);
  });
  return out;
}

double radius_of(const Result& result, const ResultPoint& point) {
  const Vec3 measured(point.position[0], point.position[1], point.position[2]);
  const Vec3 moved_point = apply(result.pose, measured);
  return result.axis.radius_of(moved_point);
}

std::array<double, 6> standard_uncertainty_of(const Mat6& covariance) {
  std::array<double, 6> standard{};
  for (std::size_t k = 0; k < standard.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    standard[k] = std::sqrt(covariance(i, i));
  }
  return standard;
}

std::string headline(const Result& result) {
  const RegionFindings edge = findings_of(result, Region::leading_edge), rest = findings_of(result, Region::rest);
  switch (result.verdict.state) {
    case BladeState::out_of_tolerance:
      if (edge.out() + rest.out() == 0) return "Out of tolerance: no pose brings all points within their tolerances";
      return fmt::format("Out of tolerance: {}, {} at the leading edge, {} on the rest of the blade",
                         counted(edge.out() + rest.out(), "point"), edge.out(), rest.out());
    case BladeState::not_decided:
      return fmt::format("Not decided: {}", result.verdict.reasons.front().text);
    case BladeState::in_tolerance:
      return "In tolerance: every point is within its tolerance";
    case BladeState::not_judged:
      break;
  }
  return "Not judged: no tolerance was set";
}

std::vector<std::string> summary_sentences(const Result& result) {
  std::vector<std::string> sentences;
  sentences.push_back(points_sentence(result));
  sentences.push_back(fit_sentence(result));
  for (const Region region : {Region::leading_edge, Region::rest}) {
    if (findings_of(result, region).points > 0) sentences.push_back(region_sentence(result, region));
  }
  if (!result.judged_otherwise.empty()) {
    sentences.push_back(
        fmt::format("A robust fit judges {} otherwise, the first of them number {}: defects that lie together draw a "
                    "least-squares fit towards themselves; compare with the loss tukey.",
                    counted(result.judged_otherwise.size(), "point"), result.judged_otherwise.front()));
  }
  return sentences;
}

}  // namespace bladefit
