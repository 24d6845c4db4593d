#include "tools/results/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/results/words.hpp"
#include "tools/results/zone_counts.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kRangesTold = 5, kZonesTold = 2;

/// The nearer of its two limits.
double nearer_limit(const Result& result, const ResultPoint& point) {
  if (point.zone == 0 || point.zone > result.zones.size()) return point.tolerance;
  const ResultZone& zone = result.zones[point.zone - 1U];
  return std::min(zone.plus, zone.minus);
}

bool has_tolerance(const ResultPoint& point) { return std::isfinite(point.tolerance); }

/// What the points of a result came to.
struct Counts {
  std::uint32_t out = 0, pending = 0, undecided = 0;
  std::uint32_t beyond = 0;  ///< of the undecided: far beyond an edge of the design
  ZoneCount zones;
};

Counts counts_of(const Result& result, const ToleranceMap& map) {
  Counts counts{.zones = ZoneCount(map)};
  for (const ResultPoint& point : result.points) {
    Verdict verdict;
    verdict.state = point.state;
    verdict.zone = point.zone;
    verdict.foot.patch = point.patch;
    verdict.foot.u = point.u;
    verdict.foot.v = point.v;
    counts.zones.count(verdict, 1);
    if (point.state == PointState::out) ++counts.out;
    if (!has_tolerance(point)) continue;
    if (point.state == PointState::pending) ++counts.pending;
    if (point.state != PointState::undecided) continue;
    ++counts.undecided;
    if (point.beyond > nearer_limit(result, point)) ++counts.beyond;
  }
  return counts;
}

std::uint32_t records_in(const std::vector<SequenceRange>& ranges) {
  std::uint32_t records = 0;
  for (const SequenceRange& range : ranges) records += range.last - range.first + 1;
  return records;
}

/// "9 to 2000, 2004".
std::string words_of(const std::vector<SequenceRange>& ranges) {
  std::string text;
  for (std::size_t k = 0; k < std::min(ranges.size(), kRangesTold); ++k) {
    const SequenceRange& r = ranges[k];
    text += (k == 0 ? "" : ", ") +
            (r.first == r.last ? fmt::format("{}", r.first) : fmt::format("{} to {}", r.first, r.last));
  }
  return text + (ranges.size() > kRangesTold ? fmt::format(" and {} more", ranges.size() - kRangesTold) : "");
}

std::string lost_text(const StreamEvidence& stream) {
  const std::uint32_t records = records_in(stream.lost);
  std::string text;
  if (records > 0)
    text = fmt::format("{} {} never arrived: {}", records, records == 1 ? "point" : "points", words_of(stream.lost));
  if (stream.lost_unnumbered)
    text += fmt::format("{}points were lost on the way before they had a number", records > 0 ? "; further " : "");
  return text + "; probe them again";
}

/// The box about those boxes of a zone that are on the patch of the first one, `k`.
ParameterBox around_zone(const ToleranceMap& map, std::uint32_t k) {
  ParameterBox around = map.boxes[k];
  for (std::uint32_t i = k; around.zone != 0 && i < map.box_count && map.boxes[i].zone == around.zone; ++i) {
    const ParameterBox& box = map.boxes[i];
    if (box.patch != around.patch) continue;
    around = {around.patch,
              std::min(around.u_min, box.u_min),
              std::max(around.u_max, box.u_max),
              std::min(around.v_min, box.v_min),
              std::max(around.v_max, box.v_max),
              around.zone};
  }
  return around;
}

/// Zones by name: "tip edge" (0).
std::string named_zones_text(const Result& result, const ZoneCount& zones, const ToleranceMap& map) {
  std::string text;
  for (std::uint32_t k = 0; k < zones.places(); ++k) {
    if (zones.lacks_points(k))
      text += fmt::format("{}\"{}\" ({})", text.empty() ? "" : ", ", zone_name(result, k + 1), zones.points(k));
  }
  return fmt::format(
      "a zone has fewer judged points than the {} it needs: {}; probe there, or correct where the zone is",
      map.least_points, text);
}

std::string zone_text(const Result& result, const ZoneCount& zones, const ToleranceMap& map) {
  if (map.zone_count > 0 && !result.zones.empty()) return named_zones_text(result, zones, map);
  std::string text;
  std::size_t missed = 0;
  for (std::uint32_t k = 0; k < zones.places(); ++k) {
    if (!zones.lacks_points(k)) continue;
    if (++missed > kZonesTold) continue;
    const ParameterBox box = around_zone(map, k);
    text += fmt::format("{}patch {} u {:g} to {:g} v {:g} to {:g} ({})", text.empty() ? "" : "; ", box.patch, box.u_min,
                        box.u_max, box.v_min, box.v_max, zones.points(k));
  }
  if (missed > kZonesTold) text += fmt::format(" and {} more", missed - kZonesTold);
  return fmt::format(
      "a leading-edge zone has fewer judged points than the {} it needs: {}; probe there, or correct the leading-edge "
      "zone",
      map.least_points, text);
}

/// Why a fit has not converged, with what to do.
std::string end_text(FitEnd ended) {
  switch (ended) {
    case FitEnd::feet_changing:
      return "feet change from side to side of the blade with every pose; leave out the points that are farthest off, "
             "or give --ignore-approach";
    case FitEnd::regions_restless:
      return "points move between the regions with every pose; widen --transition, or give --regions fixed";
    case FitEnd::program_failed:
      return "the mode has no solution to working precision; leave out the points that are farthest off, or fit with "
             "the mode least_squares";
    case FitEnd::feet_unproven:
    case FitEnd::sweeps_used_up:
    case FitEnd::none:
      break;
  }
  return "check that design, units and start belong to these points, or fit with the mode least_squares";
}

const char* them(std::size_t count) { return count == 1 ? "it" : "them"; }

std::string refused_text(const std::vector<std::uint32_t>& refused) {
  return fmt::format("{} cannot be used: no numbers, or over a thousand half sizes of the blade away; probe {} again",
                     refused.size() == 1
                         ? fmt::format("point {}", refused.front())
                         : fmt::format("{} points, the first of them number {},", refused.size(), refused.front()),
                     them(refused.size()));
}

std::string pending_text(std::size_t count) {
  return fmt::format("{} not determined well enough to be judged; probe more points near {} and over the whole blade",
                     count == 1 ? "1 point is" : fmt::format("{} points are", count), them(count));
}

std::string undecided_text(const Counts& counts) {
  const std::string beyond = fmt::format(
      "{} far beyond the edge of the design, where it says nothing of {}: add the face there (--face, --design), or "
      "leave {} out with --subset or --window",
      counts.beyond == 1 ? "1 point lies" : fmt::format("{} points lie", counts.beyond), them(counts.beyond),
      them(counts.beyond));
  if (counts.beyond == counts.undecided) return beyond;
  const std::uint32_t count = counts.undecided - counts.beyond;
  const std::string near = fmt::format(
      "{} tolerance than the expanded uncertainty; measure {} more accurately or probe more points",
      count == 1 ? "1 point is nearer to its" : fmt::format("{} points are nearer to their", count), them(count));
  return counts.beyond == 0 ? near : near + "; " + beyond;
}

/// What happened, and what to do.
class Texts {
 public:
  Texts(const Result& result, const Counts& counts, const ToleranceMap& map, const StreamEvidence& stream)
      : result_(result), counts_(counts), map_(map), stream_(stream) {}

  [[nodiscard]] std::string of(Reason reason) const {
    switch (reason) {
      case Reason::not_converged:
        return "the fit has not come to rest at an optimum: " + end_text(result_.details->ended);
      case Reason::underdetermined:
        return fmt::format(
            "{} of {} free degrees of freedom follow from the {} points that count; probe more points, spread over "
            "both sides and the whole length of the blade",
            result_.details->determined, result_.details->free, result_.all.count);
      case Reason::unproven:
        return fmt::format("{} feet could not be proven the nearest; measure these points again or leave them out",
                           result_.details->unproven);
      case Reason::points_lost:
        return lost_text(stream_);
      case Reason::points_refused:
        return refused_text(stream_.refused);
      case Reason::zone_not_probed:
        return zone_text(result_, counts_.zones, map_);
      case Reason::pending:
        return pending_text(counts_.pending);
      case Reason::undecided:
        return undecided_text(counts_);
      case Reason::unfinished:
        return "the session ended before the machine said that its program is finished; run it again with the same "
               "session folder to go on";
      case Reason::wrong_units:
      case Reason::mirrored:
      case Reason::ambiguous:
      case Reason::far_start:
        break;  // whoever finds one of these tells it
    }
    return {};
  }

 private:
  const Result& result_;
  const Counts& counts_;
  const ToleranceMap& map_;
  const StreamEvidence& stream_;
};

BladeEvidence evidence_of(const Result& result, const Counts& counts, const LocalizerConfig& config,
                          const StreamEvidence& stream) {
  return {.converged = result.status == word_of(FitStatus::converged),
          .infeasible = result.status == word_of(FitStatus::infeasible),
          .determined = result.details->determined,
          .free = result.details->free,
          .unproven = result.details->unproven,
          .judged = sets_tolerance(config.tolerance),
          .out = counts.out,
          .pending = counts.pending,
          .undecided = counts.undecided,
          .lost = records_in(stream.lost) + (stream.lost_unnumbered ? 1U : 0U),
          .refused = static_cast<std::uint32_t>(stream.refused.size()),
          .zones_missed = counts.zones.missed(),
          .finished = stream.finished,
          .doubts = result.verdict.codes()};
}

void take_back_judgement(Result& result) {
  result.points.change_each([](ResultPoint point) {
    if (point.state == PointState::rejected) return point;
    point.state = PointState::pending;
    point.action = Action::none;
    return point;
  });
}

}  // namespace

void judge(Result& result, const LocalizerConfig& config, const StreamEvidence& stream) {
  const Counts counts = counts_of(result, config.tolerance);
  const BladeVerdict verdict = judge_blade(evidence_of(result, counts, config, stream));
  const Texts texts(result, counts, config.tolerance, stream);
  const Reasons told = result.verdict.codes();
  for (std::size_t k = 0; k < kReasonWords.size(); ++k) {
    const auto reason = static_cast<Reason>(k);
    if (verdict.reasons.has(reason) && !told.has(reason)) result.verdict.reasons.push_back({reason, texts.of(reason)});
  }
  result.verdict.state = verdict.state;
  result.verdict.lost = stream.lost;
  result.verdict.decision = config.decision.rule;
  result.verdict.coverage_factor = config.decision.coverage_factor;
  if (!verdict.fit_decided()) take_back_judgement(result);
}

}  // namespace bladefit
