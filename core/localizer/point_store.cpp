#include "core/localizer/point_store.hpp"

namespace bladefit {

void PointStore::attach(StoredPoint* points, std::uint32_t* order, std::uint32_t capacity) {
  points_ = points;
  order_ = order;
  capacity_ = capacity;
}

void PointStore::clear() { size_ = next_evicted_ = searches_ = 0; }

std::uint32_t PointStore::append(const StoredPoint& point) {
  order_[size_] = size_;
  points_[size_] = point;
  return size_++;
}

void PointStore::replace(std::uint32_t index, const StoredPoint& point) {
  std::uint32_t* at = place_of(points_[index].sequence);
  std::copy(at + 1, order_ + size_, at);
  order_[size_ - 1] = index;
  points_[index] = point;
}

std::uint32_t* PointStore::place_of(std::uint32_t sequence) const {
  const auto by_sequence = [this](std::uint32_t i, std::uint32_t wanted) { return points_[i].sequence < wanted; };
  return std::lower_bound(order_, order_ + size_, sequence, by_sequence);
}

std::uint32_t PointStore::find(std::uint32_t sequence) const {
  const std::uint32_t* at = place_of(sequence);
  return at != order_ + size_ && points_[*at].sequence == sequence ? *at : size_;
}

void PointStore::record(StoredPoint& point, const Measurement& m, std::uint32_t revision) {
  point.foot = m.foot;
  point.span = m.place.span;
  point.revision = revision;
  if (m.searched) ++searches_;
  if (!m.ranked) return;
  point.ranked_at = m.r;
  point.runner_up = m.runner_up;
}

void PointStore::record(StoredPoint& point, const LaneFoot& foot, const Surface& surface, std::uint32_t revision) {
  foot.write_to(point.foot, surface);
  point.span = foot.place().span;
  point.revision = revision;
  if (!foot.proven_nearest) return;
  point.ranked_at = foot.block->feet.point(foot.lane);
  point.runner_up = nothing_within(0.0);
}

}  // namespace bladefit
