#include <algorithm>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

/// The newest points are fresh, and so are contested ones: those with a rival foot nearer than this [half diagonals]. A
/// small motion of the pose can move their foot to the other side of an edge, which no expansion foretells.
constexpr std::uint32_t kNewest = 4;
constexpr double kContestedLead = 3e-4;
/// Stored points that are looked at for one whose place a point of the leading edge may take.
constexpr std::uint32_t kPlacesLookedAt = 64;

}  // namespace

bool Localizer::contested(const StoredPoint& point) const { return point.rivals.lead < kContestedLead * frame_.length; }

void Localizer::include(FitSums& sums, const StoredPoint& point, const Measurement& m, const Vec6& x) const {
  if (!left_out(point, m.foot)) add_row(sums, point, m, row_of(m, x), x);
}

void Localizer::add_row(FitSums& sums, const StoredPoint& point, const Measurement& m, const DistanceRow& row,
                        const Vec6& x) const {
  const LossTerms terms = loss_terms(loss_, loss_scale_, m.foot.distance);
  sums.model.add(row, x, point.weight, terms);
  const Region region = regions_held_ ? point.region : region_at(config_.tolerance, m.foot.patch, m.foot.u, m.foot.v);
  sums.regions[static_cast<std::size_t>(region)].add(m.foot.distance, point.sequence);
}

void Localizer::include(FitSums& sums, const StoredPoint& point, const Measurement& m) const {
  include(sums, point, m, motion_between(sums.model.reference, pose_, frame_));
}

void Localizer::note(StoredPoint& point, const Measurement& m) {
  point.foot = m.foot;
  point.span = m.projection.place.span;
  point.revision = revision_;
  if (m.searched) ++searches_;
  if (!m.ranked) return;
  point.ranked_at = m.r;
  point.rivals = m.rivals;
}

void Localizer::count_in(const StoredPoint& point, const Measurement& m) {
  last_sequence_ = point.sequence;
  last_place_ = m.projection.place;
  ++accepted_;
}

StoredPoint* Localizer::store(const StoredPoint& point, const Measurement& m) {
  count_in(point, m);
  if (stored_ < config_.capacity) {
    order_[stored_] = stored_;
    return keep(stored_++, point, m);
  }
  const bool leading_edge = region_at(config_.tolerance, m.foot.patch, m.foot.u, m.foot.v) == Region::leading_edge &&
                            !left_out(point, m.foot);
  const std::uint32_t index = leading_edge ? place_to_give_up() : stored_;
  if (index == stored_) {
    for (FitSums* sums : {&settled_, &filling_, &frozen_}) include(*sums, point, m);
    return nullptr;
  }
  give_up(index);
  order_[stored_ - 1] = index;
  return keep(index, point, m);
}

StoredPoint* Localizer::keep(std::uint32_t index, const StoredPoint& point, const Measurement& m) {
  points_[index] = point;
  note(points_[index], m);
  if (fresh_count_ == kFreshPlaces) settle_one(0);
  make_fresh(index);
  // The new one is active at once; those that join at the end of the sweep stay behind it.
  std::swap(fresh_[fresh_count_ - 1], fresh_[active_count_]);
  ++active_count_;
  return &points_[index];
}

/// The next stored point of the rest that nothing waits for, looked for among a few; stored_ where there is none.
std::uint32_t Localizer::place_to_give_up() {
  for (std::uint32_t k = 0; k < kPlacesLookedAt; ++k) {
    const std::uint32_t index = next_given_up_;
    next_given_up_ = next_given_up_ + 1 < stored_ ? next_given_up_ + 1 : 0;
    const StoredPoint& point = points_[index];
    const bool held = tracker_.holds(index) || least_.holds(index);
    if (point.region == Region::rest && !point.fresh && !point.queued && !held) return index;
  }
  return stored_;
}

/// A point loses its place: its row stays in the sums as it is now. Leaves the last place of order_ free.
/// Cost: one projection, and moving up to `capacity` indices.
void Localizer::give_up(std::uint32_t index) {
  const StoredPoint& point = points_[index];
  const Measurement m = measure(point, pose_, Search::past_lead);
  include(frozen_, point, m);
  if (index >= cursor_) include(filling_, point, m);
  const auto by_sequence = [this](std::uint32_t i, std::uint32_t sequence) { return points_[i].sequence < sequence; };
  std::uint32_t* at = std::lower_bound(order_, order_ + stored_, point.sequence, by_sequence);
  std::copy(at + 1, order_ + stored_, at);
}

void Localizer::make_fresh(std::uint32_t index) {
  points_[index].fresh = true;
  fresh_[fresh_count_++] = index;
}

/// Gives the row of an active fresh point to the sums that last until the end of the next sweep.
void Localizer::settle_one(std::uint32_t place) {
  const std::uint32_t index = fresh_[place];
  StoredPoint& point = points_[index];
  for (std::uint32_t k = place; k + 1 < fresh_count_; ++k) fresh_[k] = fresh_[k + 1];
  --fresh_count_;
  --active_count_;
  point.fresh = false;
  const Measurement m = measure(point, pose_, Search::past_lead);
  note(point, m);
  include(settled_, point, m);
  if (index < cursor_) include(filling_, point, m);
}

/// Settles the oldest fresh points that are neither contested nor among the newest few.
void Localizer::settle() {
  std::uint32_t calm = 0;
  for (std::uint32_t k = active_count_; k-- > 0;) {
    if (!contested(points_[fresh_[k]]) && ++calm > kNewest) settle_one(k);
  }
}

/// Settles every point: batch fits and refinements go over all of them in sweeps.
void Localizer::settle_all() {
  while (active_count_ > 0) settle_one(active_count_ - 1);
  for (std::uint32_t k = 0; k < fresh_count_; ++k) points_[fresh_[k]].fresh = false;
  fresh_count_ = 0;
  current_ = settled_;
}

/// Adds the rows of the fresh points at the present pose to the settled ones; that of the very newest is at hand.
void Localizer::gather(const Measurement& newest) {
  current_ = settled_;
  const Vec6 x = motion_between(current_.model.reference, pose_, frame_);
  for (std::uint32_t first = 0; first < active_count_; first += kLanes) {
    const std::uint32_t count = std::min<std::uint32_t>(kLanes, active_count_ - first);
    LaneBlock block;
    track(block, {fresh_.data() + first, count}, x);
    for (std::uint32_t k = 0; k < count; ++k) {
      StoredPoint& point = points_[fresh_[first + k]];
      if (point.sequence == last_sequence_) {
        include(current_, point, newest, x);
        continue;
      }
      const Measurement m = measure(block, k, Search::past_lead);
      review(fresh_[first + k], m);
      include(current_, point, m, x);
    }
  }
}

/// Takes over a new foot and queues the verdict where it has changed.
void Localizer::review(std::uint32_t index, const Measurement& m) {
  note(points_[index], m);
  look_at(index, m);
  rejudge(index);
}

void Localizer::rejudge(std::uint32_t index) {
  StoredPoint& point = points_[index];
  judge(point);
  if (point.state != point.told_state || point.action != point.told_action) queue_revision(index);
}

/// Projects up to `budget` more settled points anew; at the end of the sweep the new sums take the place of the old.
void Localizer::refresh(std::uint32_t budget) {
  const Vec6 x = motion_between(filling_.model.reference, pose_, frame_);
  const std::uint32_t end = cursor_ + std::min(budget, stored_ - cursor_);
  while (cursor_ < end) {
    std::array<std::uint32_t, kLanes> indices{};
    std::uint32_t count = 0;
    for (; cursor_ < end && count < kLanes; ++cursor_) {
      if (!points_[cursor_].fresh) indices[count++] = cursor_;
    }
    LaneBlock block;
    track(block, {indices.data(), count}, x);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t index = indices[k];
      const Measurement m = measure(block, k, Search::past_lead);
      review(index, m);
      if (contested(points_[index]) && fresh_count_ + kNewest < kFreshPlaces) {
        make_fresh(index);  // its old row is still in the sums in use: it becomes active when they are given up
      } else {
        include(filling_, points_[index], m, x);
      }
    }
  }
  if (cursor_ < stored_) return;
  settled_ = filling_;
  active_count_ = fresh_count_;
  redetermine_ = true;
  begin_sweep();
}

}  // namespace bladefit
