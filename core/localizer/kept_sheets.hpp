#pragma once
#include <algorithm>
#include <cstdint>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// The sheet of the design that each point keeps while a program of single distances runs: its foot is the local
/// minimum that is reached from a kept place, not the one that a search at each pose would choose, so that every
/// distance is one function of the pose and a step can be compared with the one before. A step that counts makes the
/// places that were tried the kept ones; of one that is taken back nothing is left.
class KeptSheets {
 public:
  /// Places of the caller's memory for each point; they outlive this.
  static constexpr std::size_t kPlacesPerPoint = 3;
  void attach(SurfacePlace* places, std::uint32_t capacity) {
    kept_ = places;
    tried_ = places + capacity;
    proven_ = tried_ + capacity;
  }

  /// The point's sheet is that of this place.
  void keep(std::uint32_t i, const SurfacePlace& place) { kept_[i] = tried_[i] = place; }
  [[nodiscard]] const SurfacePlace& kept(std::uint32_t i) const { return kept_[i]; }
  /// Its foot at the pose that is tried.
  void try_place(std::uint32_t i, const SurfacePlace& place) { tried_[i] = place; }
  /// That pose counts, for the first `count` points. Cost: linear, as that of the others.
  void accept(std::uint32_t count) { std::copy(tried_, tried_ + count, kept_); }
  /// The tried places are those that a search of every foot has found.
  void prove(std::uint32_t count) { std::copy(tried_, tried_ + count, proven_); }
  /// Back to them.
  void go_back(std::uint32_t count) { std::copy(proven_, proven_ + count, kept_); }

 private:
  SurfacePlace *kept_ = nullptr, *tried_ = nullptr, *proven_ = nullptr;
};

}  // namespace bladefit
