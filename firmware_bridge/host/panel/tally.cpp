#include "firmware_bridge/host/panel/tally.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

bool is_out(const Verdict& verdict) { return verdict.state == PointState::out; }
bool is_leading_edge_out(const Verdict& verdict) { return is_out(verdict) && verdict.region == Region::leading_edge; }

/// Pending points take part in the farthest of a region where asked for.
bool takes_part(const Verdict& verdict, Region region, bool with_pending) {
  if (verdict.region != region || verdict.state == PointState::rejected) return false;
  return with_pending || verdict.state != PointState::pending;
}

}  // namespace

/// Where zones have limits of their own, that is farther which is more of its limit.
bool Tally::is_farther(const Verdict& verdict, const std::optional<Verdict>& other) const {
  if (!other) return true;
  const double distance = std::abs(verdict.foot.distance), than = std::abs(other->foot.distance);
  if (!by_limits_) return distance > than;
  return distance / verdict.tolerance_mm > than / other->tolerance_mm;
}

void Tally::accept(const Verdict& verdict) {
  const auto [place, first] = verdicts_.try_emplace(verdict.sequence);
  const Verdict before = place->second;
  if (!first) count(before, -1);
  place->second = verdict;
  count(verdict, 1);
  if (is_out(verdict) && !is_out(before)) ++times_out_;
  follow_leading_edge(verdict.sequence, is_leading_edge_out(before), is_leading_edge_out(verdict));
  follow_worst(verdict);
}

void Tally::give_up(std::uint32_t sequence) {
  const auto place = verdicts_.find(sequence);
  if (place == verdicts_.end()) return;
  const Verdict verdict = place->second;
  verdicts_.erase(place);
  for (const bool with_pending : {false, true}) {
    Worst& worst = worst_of(verdict.region, with_pending);
    if (takes_part(verdict, verdict.region, with_pending) && is_farther(verdict, worst.given_up))
      worst.given_up = verdict;
  }
  if (!is_leading_edge_out(verdict)) return;
  std::erase(leading_edge_out_, sequence);
  given_up_out_.push_back(verdict);
  if (given_up_out_.size() > kNewest) given_up_out_.pop_front();
}

void Tally::count(const Verdict& verdict, int direction) {
  const auto sign = static_cast<std::uint32_t>(direction);
  counts_.points += sign;
  zones_.count(verdict, sign);
  blade_.count(verdict, direction);
  if (verdict.state == PointState::rejected) {
    counts_.rejected += sign;
    if (!has_foot(verdict)) counts_.refused += sign;
    return;
  }
  if (std::isfinite(verdict.tolerance_mm)) {
    if (verdict.state == PointState::pending) counts_.pending += sign;
    if (verdict.state == PointState::undecided) counts_.undecided += sign;
  }
  const bool leading_edge = verdict.region == Region::leading_edge;
  if (leading_edge) counts_.leading_edge += sign;
  if (is_out(verdict)) (leading_edge ? counts_.leading_edge_out : counts_.rest_out) += sign;
}

void Tally::follow_leading_edge(std::uint32_t sequence, bool was_out, bool is_out_now) {
  if (was_out == is_out_now) return;
  if (is_out_now) {
    leading_edge_out_.push_back(sequence);
  } else {
    std::erase(leading_edge_out_, sequence);
  }
}

/// Keeps the farthest points, unless the farthest itself has come nearer.
void Tally::follow_worst(const Verdict& verdict) {
  for (const Region region : {Region::rest, Region::leading_edge}) {
    for (const bool with_pending : {false, true}) {
      Worst& worst = worst_of(region, with_pending);
      const bool takes = takes_part(verdict, region, with_pending);
      const bool was_it = worst.verdict && worst.verdict->sequence == verdict.sequence;
      if (was_it && (!takes || is_farther(*worst.verdict, verdict))) {
        worst.stale = true;
      } else if (takes && (was_it || is_farther(verdict, worst.verdict))) {
        worst.verdict = verdict;
      }
    }
  }
}

const Verdict* Tally::worst(Region region, bool with_pending) const {
  Worst& worst = worst_of(region, with_pending);
  if (worst.stale) {
    worst.verdict = worst.given_up;
    for (const auto& [sequence, verdict] : verdicts_) {
      if (takes_part(verdict, region, with_pending) && is_farther(verdict, worst.verdict)) worst.verdict = verdict;
    }
    worst.stale = false;
  }
  return worst.verdict ? &*worst.verdict : nullptr;
}

std::vector<Verdict> Tally::newest_leading_edge_out() const {
  std::vector<Verdict> newest;
  for (auto sequence = leading_edge_out_.rbegin(); sequence != leading_edge_out_.rend() && newest.size() < kNewest;
       ++sequence) {
    newest.push_back(*find(*sequence));
  }
  for (auto verdict = given_up_out_.rbegin(); verdict != given_up_out_.rend() && newest.size() < kNewest; ++verdict)
    newest.push_back(*verdict);
  return newest;
}

void Tally::clear() {
  verdicts_.clear();
  leading_edge_out_.clear();
  given_up_out_.clear();
  worst_ = {};
  counts_ = {};
  zones_.clear();
  blade_.clear();
}

const Verdict* Tally::find(std::uint32_t sequence) const {
  const auto place = verdicts_.find(sequence);
  return place != verdicts_.end() ? &place->second : nullptr;
}

}  // namespace bladefit
