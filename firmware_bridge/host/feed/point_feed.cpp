#include "firmware_bridge/host/feed/point_feed.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Distances that differ by less are shown as the same [mm].
constexpr float kSameDistance = 1e-4F;

std::array<float, 3> floats_of(const Vec3& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

FedVerdict fed_verdict(const Verdict& verdict, std::uint32_t time_ms) {
  return {.sequence = verdict.sequence,
          .time_ms = time_ms,
          .distance = static_cast<float>(verdict.foot.distance),
          .tolerance = static_cast<float>(verdict.tolerance_mm),
          .uncertainty = static_cast<float>(verdict.uncertainty_mm),
          .revision = verdict.revision,
          .state = verdict.state,
          .action = verdict.action,
          .region = verdict.region};
}

/// `same` [mm]: distances that differ by less are shown as the same.
bool looks_the_same(const FedVerdict& one, const FedVerdict& other, float same) {
  return one.state == other.state && one.action == other.action && one.region == other.region &&
         std::abs(one.distance - other.distance) < same;
}

/// What nobody sees in the colour of a point [mm].
float least_followed(const FedVerdict& verdict) {
  constexpr float kShare = 1.0F / 64, kUntolerated = 0.005F;
  return std::isfinite(verdict.tolerance) ? std::max(kShare * verdict.tolerance, kSameDistance) : kUntolerated;
}

}  // namespace

PointFeed::PointFeed(std::size_t points, std::size_t verdicts)
    : capacity_(points),
      remembered_(verdicts),
      begun_ms_(
          std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
              .count()) {
  places_.reserve(points);
  slots_.reserve(points);
}

/// The place of a point, which may be a new one: then its `last` is 0.
PointFeed::Place& PointFeed::place_of(std::uint32_t sequence) {
  const auto [entry, is_new] = slots_.try_emplace(sequence, 0);
  if (!is_new) return places_[entry->second];
  std::size_t slot = places_.size();
  if (slot < capacity_) {
    places_.emplace_back();
  } else {
    slot = oldest_;
    oldest_ = (oldest_ + 1) % capacity_;
    slots_.erase(places_[slot].point.verdict.sequence);
    places_[slot] = {};
  }
  places_[slot].point.slot = static_cast<std::uint32_t>(slot);
  slots_[sequence] = static_cast<std::uint32_t>(slot);
  return places_[slot];
}

FedVerdict PointFeed::fed(const Verdict& verdict) const {
  const auto age = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_);
  return fed_verdict(verdict, static_cast<std::uint32_t>(age.count()));
}

/// Makes it the newest change.
void PointFeed::put(Place& place, const Verdict& verdict, const Remembered& now) {
  place.point.verdict = now.verdict;
  place.point.foot = floats_of(verdict.foot.point);
  place.point.normal = floats_of(verdict.foot.normal);
  remembered_[++last_ % remembered_.size()] = now;
  place.last = last_;
}

void PointFeed::judged(const Verdict& verdict) {
  const FedVerdict now = fed(verdict);
  const std::lock_guard lock(mutex_);
  Place& place = place_of(verdict.sequence);
  if (place.last > 0 && looks_the_same(place.point.verdict, now, kSameDistance)) return;
  put(place, verdict, {.verdict = now, .before = place.last});
}

void PointFeed::followed(const Verdict& verdict) {
  const FedVerdict now = fed(verdict);
  const std::lock_guard lock(mutex_);
  const auto entry = slots_.find(verdict.sequence);
  if (entry == slots_.end()) return;
  Place& place = places_[entry->second];
  if (looks_the_same(place.point.verdict, now, least_followed(now))) return;
  const bool again = is_remembered(place.last) && remembered(place.last).followed;
  put(place, verdict, {.verdict = now, .before = again ? remembered(place.last).before : place.last, .followed = true});
}

void PointFeed::clear() {
  const std::lock_guard lock(mutex_);
  places_.clear();
  slots_.clear();
  oldest_ = 0;
  // Numbers go on, so that what is remembered of before is nobody's.
  ++cleared_;
}

FeedPlace PointFeed::end() const {
  const std::lock_guard lock(mutex_);
  return {cleared_, static_cast<std::uint32_t>(places_.size()), last_ + 1};
}

FeedPiece PointFeed::read(const FeedPlace& from, std::span<FedPoint> to) const {
  const std::size_t room = std::min(to.size(), kLongestPiece);
  const std::lock_guard lock(mutex_);
  FeedPiece piece{.next = from};
  FeedPlace& next = piece.next;
  const bool forgotten = next.change > 0 && next.change <= last_ && !is_remembered(next.change);
  if (next.change == 0 || next.change > last_ + 1 || next.cleared != cleared_ || forgotten) {
    piece.afresh = true;
    next = {cleared_, 0, last_ + 1};
  }
  // What has changed since the reader began comes with the changes.
  for (; next.slot < places_.size() && piece.count < room; ++next.slot) {
    const Place& place = places_[next.slot];
    if (place.last < next.change) to[piece.count++] = place.point;
  }
  // A verdict that is not its point's last one is looked at and left out: those count against the room too.
  for (std::size_t looked = piece.count; next.change <= last_ && looked < room; ++looked, ++next.change) {
    const auto entry = slots_.find(remembered(next.change).verdict.sequence);
    if (entry == slots_.end() || places_[entry->second].last != next.change) continue;
    to[piece.count++] = places_[entry->second].point;
  }
  piece.more = next.slot < places_.size() || next.change <= last_;
  return piece;
}

std::size_t PointFeed::history(std::uint32_t sequence, std::span<FedVerdict> to) const {
  const std::lock_guard lock(mutex_);
  const auto entry = slots_.find(sequence);
  if (entry == slots_.end()) return 0;
  std::size_t count = 0;
  for (std::uint64_t number = places_[entry->second].last; is_remembered(number) && count < to.size();
       number = remembered(number).before) {
    to[count++] = remembered(number).verdict;
  }
  return count;
}

}  // namespace bladefit
