#include "tools/report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/report_text.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

std::string readable(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string place_of(const SessionReport& report, const ReportPoint& point) {
  return fmt::format("point {}, patch {}, u {:.4f}, v {:.4f}, radius {:.2f} {}", point.sequence, point.patch, point.u,
                     point.v, radius_of(report, point), report.fit.units);
}

std::string points_sentence(const SessionReport& report) {
  const std::uint32_t rejected = rejected_points(report);
  if (rejected == 0) return fmt::format("{} measured, all of them judged.", counted(report.points.size(), "point"));
  return fmt::format("{} measured; {} not count, because the foot lies on an edge of the design or outside the window.",
                     counted(report.points.size(), "point"), rejected == 1 ? "1 does" : fmt::format("{} do", rejected));
}

std::string fit_sentence(const SessionReport& report) {
  const ReportedFit& fit = report.fit;
  const LengthText text(fit.units);
  return fmt::format("Fit ({}): {}; {} in it, RMS distance {} (before the fit {}), largest {}.", readable(fit.mode),
                     readable(fit.status), counted(fit.count, "point"), text.with_unit(fit.rms_after),
                     text.with_unit(fit.rms_before), text.with_unit(fit.max_abs_after));
}

std::string out_sentence(const SessionReport& report, const RegionFindings& found) {
  if (found.worst_out == nullptr) return "none is out.";
  return fmt::format("{} {} out: {} to cut, {} to weld. Worst: {}, {}; {}.", found.out(),
                     found.out() == 1 ? "is" : "are", found.cut, found.weld,
                     LengthText(report.fit.units).with_sign_and_unit(found.worst_out->distance),
                     word_of(found.worst_out->action), place_of(report, *found.worst_out));
}

std::string region_sentence(const SessionReport& report, Region region) {
  const bool leading_edge = region == Region::leading_edge;
  const RegionFindings found = findings_of(report, region);
  const double tolerance = (leading_edge ? report.fit.leading_edge : report.fit.rest).tolerance;
  std::string text =
      fmt::format("{}: {}, ", leading_edge ? "Leading edge" : "Rest of the blade", counted(found.points, "point"));
  if (!std::isfinite(tolerance)) return text + "no tolerance was set: not judged.";
  text += fmt::format("tolerance ±{}; ", LengthText(report.fit.units).with_unit(tolerance));
  text += out_sentence(report, found);
  if (found.pending > 0)
    text += fmt::format(" {} of them not decided, because the points do not determine the fit there.", found.pending);
  return text;
}

}  // namespace

RegionFindings findings_of(const SessionReport& report, Region region) {
  RegionFindings found;
  for (const ReportPoint& point : report.points) {
    if (point.region != region || point.state == PointState::rejected) continue;
    ++found.points;
    if (point.state == PointState::pending) ++found.pending;
    if (point.state != PointState::out) continue;
    ++(point.distance > 0 ? found.cut : found.weld);
    if (found.worst_out == nullptr || std::abs(point.distance) > std::abs(found.worst_out->distance))
      found.worst_out = &point;
  }
  return found;
}

std::uint32_t rejected_points(const SessionReport& report) {
  return static_cast<std::uint32_t>(
      std::count_if(report.points.begin(), report.points.end(),
                    [](const ReportPoint& point) { return point.state == PointState::rejected; }));
}

std::vector<const ReportPoint*> out_of_tolerance(const SessionReport& report) {
  std::vector<const ReportPoint*> out;
  for (const ReportPoint& point : report.points) {
    if (point.state == PointState::out) out.push_back(&point);
  }
  std::stable_sort(out.begin(), out.end(), [](const ReportPoint* a, const ReportPoint* b) {
    if (a->region != b->region) return a->region == Region::leading_edge;
    return std::abs(a->distance) > std::abs(b->distance);
  });
  return out;
}

double radius_of(const SessionReport& report, const ReportPoint& point) {
  const Vec3 measured(point.position[0], point.position[1], point.position[2]);
  const Vec3 moved_point = apply(report.fit.pose, measured);
  return std::hypot(moved_point[1], moved_point[2]);
}

Outcome outcome_of(const SessionReport& report) {
  const RegionFindings edge = findings_of(report, Region::leading_edge), rest = findings_of(report, Region::rest);
  if (edge.out() + rest.out() > 0) return Outcome::out_of_tolerance;
  if (edge.pending + rest.pending > 0 || report.fit.status != "converged") return Outcome::undecided;
  const auto judged = [](const ReportPoint& point) {
    return point.state == PointState::in && std::isfinite(point.tolerance);
  };
  const bool any = std::any_of(report.points.begin(), report.points.end(), judged);
  return any ? Outcome::in_tolerance : Outcome::not_judged;
}

std::string headline(const SessionReport& report) {
  const RegionFindings edge = findings_of(report, Region::leading_edge), rest = findings_of(report, Region::rest);
  switch (outcome_of(report)) {
    case Outcome::out_of_tolerance:
      return fmt::format("Out of tolerance: {}, {} at the leading edge, {} elsewhere",
                         counted(edge.out() + rest.out(), "point"), edge.out(), rest.out());
    case Outcome::undecided:
      return "Not decided: the fit is not final";
    case Outcome::in_tolerance:
      return "In tolerance: no point is out";
    case Outcome::not_judged:
      break;
  }
  return "Not judged: no tolerance was set";
}

std::vector<std::string> summary_sentences(const SessionReport& report) {
  std::vector<std::string> sentences = {points_sentence(report), fit_sentence(report)};
  for (const Region region : {Region::leading_edge, Region::rest}) {
    if (findings_of(report, region).points > 0) sentences.push_back(region_sentence(report, region));
  }
  return sentences;
}

}  // namespace bladefit
