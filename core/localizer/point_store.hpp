#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/localizer/measurement.hpp"
#include "core/localizer/stored_point.hpp"
#include "core/localizer/tuning.hpp"

namespace bladefit {

/// The points that have a place in the caller's memory, with their order by sequence.
class PointStore {
 public:
  /// `points` and `order`: capacity of each, constructed; they outlive the store.
  void attach(StoredPoint* points, std::uint32_t* order, std::uint32_t capacity);
  void clear();

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] bool full() const { return size_ == capacity_; }
  [[nodiscard]] StoredPoint& operator[](std::uint32_t index) { return points_[index]; }
  [[nodiscard]] const StoredPoint& operator[](std::uint32_t index) const { return points_[index]; }

  /// Takes a point of a higher sequence than all others into a free place, and returns its index.
  std::uint32_t append(const StoredPoint& point);
  /// The same in the place of another one. Cost: moves up to `capacity` indices.
  void replace(std::uint32_t index, const StoredPoint& point);
  /// Index of the point of this sequence; size() where there is none. Cost: logarithmic.
  [[nodiscard]] std::uint32_t find(std::uint32_t sequence) const;
  /// The next point of the rest of the blade that nothing waits for and `in_use(index)` does not hold, looked for among
  /// a few; size() where there is none.
  template <class InUse>
  [[nodiscard]] std::uint32_t next_to_evict(InUse in_use);

  /// Takes over what was measured of a point, stored or passing, at the pose of this revision.
  void record(StoredPoint& point, const Measurement& m, std::uint32_t revision);
  /// The same of a foot in a lane.
  void record(StoredPoint& point, const LaneFoot& foot, const Surface& surface, std::uint32_t revision);
  /// A global search was made for a point without recording what it found.
  void count_search() { ++searches_; }
  /// Global searches for the feet of points so far, those for a window left out.
  [[nodiscard]] std::uint32_t searches() const { return searches_; }

 private:
  /// Where in order_ this sequence stands, or would stand.
  [[nodiscard]] std::uint32_t* place_of(std::uint32_t sequence) const;

  StoredPoint* points_ = nullptr;
  std::uint32_t* order_ = nullptr;  ///< indices by rising sequence
  std::uint32_t capacity_ = 0, size_ = 0;
  std::uint32_t next_evicted_ = 0;
  std::uint32_t searches_ = 0;
};

template <class InUse>
std::uint32_t PointStore::next_to_evict(InUse in_use) {
  for (std::uint32_t k = 0; k < tuning::kEvictionLooks; ++k) {
    const std::uint32_t index = next_evicted_;
    next_evicted_ = next_evicted_ + 1 < size_ ? next_evicted_ + 1 : 0;
    const StoredPoint& point = points_[index];
    const bool used = in_use(index);
    if (point.region == Region::rest && !point.recent && !point.queued && !used) return index;
  }
  return size_;
}

}  // namespace bladefit
