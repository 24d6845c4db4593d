#include "tools/design/ridge/ridge_zone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace bladefit {
namespace {

/// Sections that begin so near to the edge of a patch are meant to begin on it.
constexpr double kOnEdge = 1e-3;
/// Limits are first tried with this error [mm], then with one greater by this factor, up to so often.
constexpr double kLeastError = 1e-3, kGrowth = 1.25;
constexpr int kMostTries = 100;

/// The part of one section of a zone that lies on one patch.
struct ZoneRun {
  std::size_t section = 0;
  double constant = 0;                   ///< of the section on this patch
  double low = 1, high = 0;              ///< limits of the other parameter
  double low_speed = 0, high_speed = 0;  ///< length per parameter at the limits [mm]
};

/// Where runs belong together: patch, whether they run along u, and which of several runs on the patch.
using RunPlace = std::tuple<std::uint32_t, bool, int>;
using RunsByPlace = std::map<RunPlace, std::vector<ZoneRun>>;

double speed_at(const Surface& surface, const SectionPoint& at, bool along_u) {
  const SurfacePoint point = surface.evaluate(surface.place_at(at.patch, at.u, at.v));
  return along_u ? point.s_u.norm() : point.s_v.norm();
}

/// The points of a section from one arc to another, both of which may lie beyond its ends where it is closed.
std::vector<SectionPoint> part_of_section(const Surface& surface, const SectionLine& section, double from, double to) {
  std::vector<SectionPoint> part = {place_on(surface, section, from)};
  for (const int round : {-1, 0, 1}) {
    if (round != 0 && !section.closed) continue;
    for (const SectionPoint& point : section.points) {
      const double arc = point.arc + round * section.length();
      if (arc > from && arc < to) part.push_back(point);
    }
  }
  part.push_back(place_on(surface, section, to));
  return part;
}

/// Adds the points of one patch that follow each other as a run.
void add_run(const Surface& surface, const std::vector<SectionPoint>& points, std::size_t section, RunsByPlace& runs) {
  const auto [least_u, most_u] = std::ranges::minmax_element(points, {}, &SectionPoint::u);
  const auto [least_v, most_v] = std::ranges::minmax_element(points, {}, &SectionPoint::v);
  const bool along_u = most_u->u - least_u->u > most_v->v - least_v->v;
  const SectionPoint &low = along_u ? *least_u : *least_v, &high = along_u ? *most_u : *most_v;
  ZoneRun run{section, along_u ? low.v : low.u, along_u ? low.u : low.v, along_u ? high.u : high.v, 0, 0};
  if (!(run.high > run.low)) return;
  run.low_speed = speed_at(surface, low, along_u);
  run.high_speed = speed_at(surface, high, along_u);
  // A zone about a seam is at both ends of its patch.
  const int place = run.low < kOnEdge * kOnEdge ? 0 : (run.high > 1.0 - kOnEdge * kOnEdge ? 2 : 1);
  runs[{low.patch, along_u, place}].push_back(run);
}

/// What a box must hold between two sections.
struct Limits {
  double low_min = 1, low_max = 0, high_min = 1, high_max = 0;

  void take(double low, double high) {
    low_min = std::min(low_min, low), low_max = std::max(low_max, low);
    high_min = std::min(high_min, high), high_max = std::max(high_max, high);
  }
};

/// Whether runs follow each other from section to section, so that a box may hold both.
bool adjoin(const ZoneRun& a, const ZoneRun& b) { return a.section + 1 == b.section; }

/// Where the part of a run ends in the constant parameter, towards `next` or, without one, away from `behind`: at the
/// edge of the patch, or half a step farther.
double limit_of(const ZoneRun& run, const ZoneRun* next, const ZoneRun* behind) {
  if (next != nullptr) return 0.5 * (run.constant + next->constant);
  if (run.constant < kOnEdge) return 0.0;
  if (run.constant > 1.0 - kOnEdge) return 1.0;
  const double step = behind == nullptr ? 0.0 : 0.5 * (run.constant - behind->constant);
  return std::clamp(run.constant + step, 0.0, 1.0);
}

/// The boxes of runs that belong together, each as long as its limits are off by no more than `error` [mm].
class BoxRow {
 public:
  BoxRow(const RunPlace& place, std::vector<ZoneRun> runs) : place_(place), runs_(std::move(runs)) {}

  /// Adds the boxes, and returns the largest error among them [mm].
  double add(double error, std::vector<ParameterBox>& boxes) const {
    double largest = 0;
    for (std::size_t first = 0; first < runs_.size();) {
      Limits limits = limits_of(first);
      double speed = fastest(first);
      std::size_t last = first;
      while (last + 1 < runs_.size() && adjoin(runs_[last], runs_[last + 1])) {
        Limits wider = limits;
        const Limits next = limits_of(last + 1);
        wider.take(next.low_min, next.high_min);
        wider.take(next.low_max, next.high_max);
        if (error_of(wider, std::max(speed, fastest(last + 1))) > error) break;
        limits = wider;
        speed = std::max(speed, fastest(++last));
      }
      largest = std::max(largest, error_of(limits, speed));
      boxes.push_back(box_of(first, last, limits));
      first = last + 1;
    }
    return largest;
  }

 private:
  [[nodiscard]] const ZoneRun* before(std::size_t k) const {
    return k > 0 && adjoin(runs_[k - 1], runs_[k]) ? &runs_[k - 1] : nullptr;
  }
  [[nodiscard]] const ZoneRun* after(std::size_t k) const {
    return k + 1 < runs_.size() && adjoin(runs_[k], runs_[k + 1]) ? &runs_[k + 1] : nullptr;
  }
  [[nodiscard]] double fastest(std::size_t k) const { return std::max(runs_[k].low_speed, runs_[k].high_speed); }

  /// Over the part of a run, which reaches half way to its neighbours.
  [[nodiscard]] Limits limits_of(std::size_t k) const {
    const ZoneRun& run = runs_[k];
    Limits limits;
    limits.take(run.low, run.high);
    for (const ZoneRun* other : {before(k), after(k)}) {
      if (other != nullptr) limits.take(0.5 * (run.low + other->low), 0.5 * (run.high + other->high));
    }
    return limits;
  }

  static double error_of(const Limits& limits, double speed) {
    return 0.5 * speed * std::max(limits.low_max - limits.low_min, limits.high_max - limits.high_min);
  }

  [[nodiscard]] ParameterBox box_of(std::size_t first, std::size_t last, const Limits& limits) const {
    const auto [patch, along_u, slot] = place_;
    const double low = 0.5 * (limits.low_min + limits.low_max), high = 0.5 * (limits.high_min + limits.high_max);
    double from = limit_of(runs_[first], before(first), after(first));
    double to = limit_of(runs_[last], after(last), before(last));
    if (from > to) std::swap(from, to);
    return along_u ? ParameterBox{patch, low, high, from, to} : ParameterBox{patch, from, to, low, high};
  }

  RunPlace place_;
  std::vector<ZoneRun> runs_;
};

std::vector<ParameterBox> boxes_of(const std::vector<BoxRow>& rows, std::size_t most, double& error) {
  double allowed = kLeastError;
  std::vector<ParameterBox> boxes;
  for (int k = 0; k < kMostTries; ++k, allowed *= kGrowth) {
    boxes.clear();
    error = 0;
    for (const BoxRow& row : rows) error = std::max(error, row.add(allowed, boxes));
    if (boxes.size() <= most) break;
  }
  return boxes;
}

}  // namespace

RidgeZone ridge_zone(const Surface& surface, const RidgedBlade& blade, std::size_t ridge, const ZoneReach& reach,
                     std::size_t most_boxes) {
  RidgeZone zone;
  zone.least_reach_mm = zone.least_chord_mm = std::numeric_limits<double>::infinity();
  RunsByPlace runs;
  for (std::size_t k = 0; k < blade.sections.size(); ++k) {
    const RidgedSection& section = blade.sections[k];
    if (!section.ridges[ridge]) continue;
    const SectionRidge& own = *section.ridges[ridge];
    const auto& other = section.ridges[1 - ridge];
    const SectionSides sides = sides_of(section.line, own, other ? &*other : nullptr);
    const double chord = chord_of(section.line, own, other ? &*other : nullptr);
    const double length = reach.percent ? 0.01 * reach.amount * chord : reach.amount;
    zone.least_reach_mm = std::min(zone.least_reach_mm, length);
    zone.most_reach_mm = std::max(zone.most_reach_mm, length);
    zone.least_chord_mm = std::min(zone.least_chord_mm, chord);
    zone.most_chord_mm = std::max(zone.most_chord_mm, chord);
    zone.clipped = zone.clipped || length > std::min(sides.after, sides.before);
    const double from = own.place.arc - std::min(length, sides.before);
    const std::vector<SectionPoint> part =
        part_of_section(surface, section.line, from, own.place.arc + std::min(length, sides.after));
    for (std::size_t i = 0; i < part.size();) {
      std::vector<SectionPoint> piece;
      const std::uint32_t patch = part[i].patch;
      const auto follows = [&](const SectionPoint& point) {
        return point.patch == patch &&
               (piece.empty() || std::hypot(point.u - piece.back().u, point.v - piece.back().v) < 0.5);
      };
      while (i < part.size() && follows(part[i])) piece.push_back(part[i++]);
      add_run(surface, piece, k, runs);
    }
  }
  std::vector<BoxRow> rows;
  for (auto& [place, own] : runs) rows.emplace_back(place, own);
  zone.boxes = boxes_of(rows, most_boxes, zone.error_mm);
  return zone;
}

}  // namespace bladefit
