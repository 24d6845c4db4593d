#include "firmware_bridge/host/panel/tally.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

bool is_out(const Verdict& verdict) { return verdict.state == PointState::out; }
bool is_leading_edge_out(const Verdict& verdict) { return is_out(verdict) && verdict.region == Region::leading_edge; }

}  // namespace

void Tally::accept(const Verdict& verdict) {
  auto place = verdicts_.end();
  if (!verdicts_.empty() && verdicts_.back().sequence >= verdict.sequence) {
    place = std::ranges::lower_bound(verdicts_, verdict.sequence, {}, &Verdict::sequence);
  }
  Verdict before;
  if (place != verdicts_.end() && place->sequence == verdict.sequence) {
    before = *place;
    count(before, static_cast<std::uint32_t>(-1));
    *place = verdict;
  } else {
    verdicts_.insert(place, verdict);
  }
  count(verdict, 1);
  if (is_out(verdict) && !is_out(before)) ++times_out_;
  follow_leading_edge(verdict.sequence, is_leading_edge_out(before), is_leading_edge_out(verdict));
}

// `sign` is +1 or -1 modulo 2^32.
void Tally::count(const Verdict& verdict, std::uint32_t sign) {
  counts_.points += sign;
  zones_.count(verdict, sign);
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

const Verdict* Tally::worst(Region region, bool with_pending) const {
  const Verdict* worst = nullptr;
  for (const Verdict& verdict : verdicts_) {
    if (verdict.region != region || verdict.state == PointState::rejected) continue;
    if (verdict.state == PointState::pending && !with_pending) continue;
    if (worst == nullptr || std::abs(verdict.foot.distance) > std::abs(worst->foot.distance)) worst = &verdict;
  }
  return worst;
}

void Tally::clear() {
  verdicts_.clear();
  leading_edge_out_.clear();
  counts_ = {};
  zones_.clear();
}

const Verdict* Tally::find(std::uint32_t sequence) const {
  const auto place = std::ranges::lower_bound(verdicts_, sequence, {}, &Verdict::sequence);
  return place != verdicts_.end() && place->sequence == sequence ? &*place : nullptr;
}

}  // namespace bladefit
