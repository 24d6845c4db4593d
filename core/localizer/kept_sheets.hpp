#pragma once
#include <cstdint>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// Places of a point, side by side so that they take no more memory than they must.
struct KeptPlaces {
  enum Which : std::uint8_t { kept, tried, proven };
  double u[3] = {}, v[3] = {};
  std::uint32_t span[3] = {};

  [[nodiscard]] SurfacePlace get(Which k) const { return {span[k], u[k], v[k]}; }
  void set(Which k, const SurfacePlace& place) {
    span[k] = place.span;
    u[k] = place.u;
    v[k] = place.v;
  }
  void copy(Which from, Which to) {
    span[to] = span[from];
    u[to] = u[from];
    v[to] = v[from];
  }
};

/// The sheet of the design that each point keeps while a program of single distances runs: its foot is the local
/// minimum that is reached from a kept place, not the one that a search at each pose would choose, so that every
/// distance is one function of the pose and a step can be compared with the one before. A step that counts makes the
/// places that were tried the kept ones; of one that is taken back nothing is left.
class KeptSheets {
 public:
  /// One for each point; they outlive this.
  void attach(KeptPlaces* places) { places_ = places; }

  /// The point's sheet is that of this place.
  void keep(std::uint32_t i, const SurfacePlace& place) {
    places_[i].set(KeptPlaces::kept, place);
    places_[i].set(KeptPlaces::tried, place);
  }
  [[nodiscard]] SurfacePlace kept(std::uint32_t i) const { return places_[i].get(KeptPlaces::kept); }
  /// Its foot at the pose that is tried.
  void try_place(std::uint32_t i, const SurfacePlace& place) { places_[i].set(KeptPlaces::tried, place); }
  /// That pose counts, for the first `count` points. Cost: linear, as that of the others.
  void accept(std::uint32_t count) { copy(count, KeptPlaces::tried, KeptPlaces::kept); }
  /// The tried places are those that a search of every foot has found.
  void prove(std::uint32_t count) { copy(count, KeptPlaces::tried, KeptPlaces::proven); }
  /// Back to them.
  void go_back(std::uint32_t count) { copy(count, KeptPlaces::proven, KeptPlaces::kept); }

 private:
  void copy(std::uint32_t count, KeptPlaces::Which from, KeptPlaces::Which to) {
    for (std::uint32_t i = 0; i < count; ++i) places_[i].copy(from, to);
  }

  KeptPlaces* places_ = nullptr;
};

}  // namespace bladefit
